#include "scene/build/material_builder.h"

#include "scene/build/fill_parameters.h"

namespace lancer {

Material MaterialBuilder::make(const MaterialDescription& m, const std::function<uint32_t(const TextureUse&)>& id_of)
{
    Material made;
    for_each_material_type([&]<class M> {
        if constexpr (!std::is_same_v<M, Mix>) {
            if (M::type != m.type) return;
            M& material = made.emplace<M>();
            fill_parameters(material, m, id_of);
            finish(material, m);
        }
    });
    return made;
}

void MaterialBuilder::finish(Metal& metal, const MaterialDescription& m)
{
    if (m.eta && m.k) metal.conductor = make_conductor(*m.eta, *m.k);
    if (options_.multiscatter) metal.compensation = &AlbedoTable::white();
}

void MaterialBuilder::finish(Glass& glass, const MaterialDescription& m)
{
    glass.fresnel = options_.fresnel;
    glass.thin = m.thin.value_or(false);
}

void MaterialBuilder::finish(Plastic& plastic, const MaterialDescription& m)
{
    plastic.mean_through = mean_transmittance(m.ior);
    const float alpha = alpha_of_roughness(m.roughness);
    if (alpha == 0) return;
    auto& coat = coats_[m.ior];
    if (!coat) coat = std::make_shared<AlbedoTable>(m.ior);
    if (plastic.roughness.texture == no_texture)
        coat->need(alpha);
    else
        coat->need_all();
    plastic.coat = coat;
}

void MaterialBuilder::finish(Interface& interface, const MaterialDescription&) { interface.fresnel = options_.fresnel; }

}  // namespace lancer
