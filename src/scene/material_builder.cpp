#include "scene/material_builder.h"

namespace lancer {

Material make_material(const MaterialDescription& m, const MaterialOptions&,
                       const std::function<uint32_t(const TextureUse&)>& id_of)
{
    const ColorParam base{m.base_color, id_of(m.base_color_map)};
    switch (m.type) {
        case MaterialType::mirror:
        case MaterialType::metal:
            return Mirror{base};
        case MaterialType::glass:
            return Glass{base, m.ior};
        default:
            return Lambert{base};
    }
}

}  // namespace lancer
