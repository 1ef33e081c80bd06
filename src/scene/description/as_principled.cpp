#include "scene/description/as_principled.h"

#include <utility>

namespace lancer {

bool as_principled(MaterialDescription& m)
{
    constexpr Color white{1, 1, 1};
    const MaterialType before = m.type;
    if (before == MaterialType::principled) return true;
    if (m.eta || m.k) return false;
    switch (before) {
        case MaterialType::lambert:
            m.specular_weight = 0;
            break;
        case MaterialType::mirror:
            m.metallic = 1.0f, m.roughness = 0, m.roughness_map.reset();
            break;
        case MaterialType::metal:
            if (!m.metallic) m.metallic = 1.0f;
            break;
        case MaterialType::plastic:
            break;
        case MaterialType::glass:
            m.transmission = 1;
            break;
        default:
            return false;
    }
    m.type = MaterialType::principled;
    m.transmittance = white;
    if (before == MaterialType::glass) {
        m.transmittance = std::exchange(m.base_color, white);
        m.transmittance_map = std::exchange(m.base_color_map, {});
    }
    return true;
}

}  // namespace lancer
