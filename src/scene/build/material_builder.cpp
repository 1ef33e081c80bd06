#include "scene/build/material_builder.h"

#include "scene/build/fill_parameters.h"

namespace lancer {
namespace {

// A table must answer for each alpha of a surface.
template <class Table>
void need_alpha_of(Table& table, const FloatParam& roughness)
{
    if (roughness.texture == no_texture)
        table.need(alpha_of_roughness(roughness.value));
    else
        table.need_all();
}
// A texture only takes away.
bool may_be_rough(const FloatParam& roughness) { return alpha_of_roughness(roughness.value) > 0; }

}  // namespace

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
    if (!options_.multiscatter || !may_be_rough(metal.roughness)) return;
    if (!reflectors_) reflectors_ = std::make_shared<AlbedoTable>(FacetKind::reflector);
    need_alpha_of(*reflectors_, metal.roughness);
    metal.compensation = reflectors_;
}

void MaterialBuilder::finish(Glass& glass, const MaterialDescription& m)
{
    glass.fresnel = options_.fresnel;
    glass.thin = m.thin.value_or(false);
    if (!options_.multiscatter || !may_be_rough(glass.roughness)) return;
    if (glass.thin && !glass.fresnel) return;  // its lobes are not those of the tables
    auto& losses = glasses_[{glass.ior, glass.thin, m.priority.has_value()}];
    if (!losses) losses = std::make_shared<GlassLosses>(glass.ior, glass.thin);
    need_alpha_of(*losses, glass.roughness);
    glass.losses = losses;
}

void MaterialBuilder::touch(std::span<const Medium> media)
{
    for (auto& [kind, losses] : glasses_)
        for (const Medium& m : media)
            if (kind.has_priority && m.priority) losses->touch(m.ior);
}

void MaterialBuilder::finish(Plastic& plastic, const MaterialDescription& m)
{
    plastic.mean_through = static_cast<float>(mean_transmittance(double{m.ior}));
    if (!may_be_rough(plastic.roughness)) return;
    auto& coat = coats_[m.ior];
    if (!coat) coat = std::make_shared<AlbedoTable>(FacetKind::coat, static_cast<double>(m.ior));
    need_alpha_of(*coat, plastic.roughness);
    plastic.coat = coat;
}

void MaterialBuilder::finish(Interface& interface, const MaterialDescription&) { interface.fresnel = options_.fresnel; }

}  // namespace lancer
