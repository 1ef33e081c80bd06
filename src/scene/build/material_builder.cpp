#include "scene/build/material_builder.h"

namespace lancer {

Material MaterialBuilder::make(const MaterialDescription& m, const std::function<uint32_t(const TextureUse&)>& id_of)
{
    const ColorParam base{m.base_color, id_of(m.base_color_map)};
    switch (m.type) {
        case MaterialType::mirror:
            return Mirror{base};
        case MaterialType::metal: {
            Metal metal{base, {m.roughness, id_of(m.roughness_map)}};
            if (m.eta && m.k) metal.conductor = make_conductor(*m.eta, *m.k);
            if (options_.multiscatter) metal.compensation = &AlbedoTable::white();
            return metal;
        }
        case MaterialType::glass:
            return Glass{base, m.ior, {m.roughness, id_of(m.roughness_map)}, options_.fresnel};
        case MaterialType::plastic: {
            Plastic plastic{.base = base,
                            .roughness = {m.roughness, id_of(m.roughness_map)},
                            .ior = m.ior,
                            .specular = m.specular,
                            .mean_through = mean_transmittance(m.ior)};
            if (alpha_of_roughness(m.roughness) == 0) return plastic;
            auto& coat = coats_[m.ior];
            if (!coat) coat = std::make_shared<const AlbedoTable>(m.ior);
            plastic.coat = coat;
            return plastic;
        }
        case MaterialType::interface:
            return Interface{base, m.phong, options_.fresnel};
        default:
            return Lambert{base};
    }
}

}  // namespace lancer
