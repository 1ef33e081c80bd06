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

bool is_constant(const FloatParam& p) { return p.texture == no_texture; }

// The roughness of a principled base, if it is the same everywhere; it is the coat's as well.
std::optional<float> only_roughness(const Principled& p)
{
    if (!is_constant(p.roughness) || !is_constant(p.coat) || !is_constant(p.coat_roughness)) return {};
    const float coat = alpha_of_roughness(p.coat_roughness.value);
    return roughness_under_coat(p.roughness.value, p.coat.value, coat > 0 ? std::sqrt(coat) : 0);
}

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
    metal.compensation = reflectors([&](AlbedoTable& table) { need_alpha_of(table, metal.roughness); });
}

template <class Need>
std::shared_ptr<const AlbedoTable> MaterialBuilder::reflectors(const Need& need)
{
    if (!reflectors_) reflectors_ = std::make_shared<AlbedoTable>(FacetKind::reflector);
    need(*reflectors_);
    return reflectors_;
}

void MaterialBuilder::finish(Glass& glass, const MaterialDescription& m)
{
    glass.fresnel = options_.fresnel;
    glass.thin = m.thin.value_or(false);
    if (may_be_rough(glass.roughness))
        add_losses(glass, m, [&](GlassLosses& losses) { need_alpha_of(losses, glass.roughness); });
}

template <class Need>
void MaterialBuilder::add_losses(Glass& glass, const MaterialDescription& m, const Need& need)
{
    if (!options_.multiscatter) return;
    if (glass.thin && !glass.fresnel) return;  // its lobes are not those of the tables
    auto& losses = glasses_[{glass.ior, glass.thin, m.priority.has_value()}];
    if (!losses) losses = std::make_shared<GlassLosses>(glass.ior, glass.thin);
    need(*losses);
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
    plastic.coat = coat_of(m.ior, [&](AlbedoTable& table) { need_alpha_of(table, plastic.roughness); });
}

template <class Need>
std::shared_ptr<const AlbedoTable> MaterialBuilder::coat_of(float ior, const Need& need)
{
    auto& coat = coats_[ior];
    if (!coat) coat = std::make_shared<AlbedoTable>(FacetKind::coat, static_cast<double>(ior));
    need(*coat);
    return coat;
}

std::shared_ptr<const AnisotropicTable> MaterialBuilder::wide_of(FacetKind kind, double eta)
{
    auto& table = wide_[{kind, eta}];
    if (!table) {
        table = std::make_shared<AnisotropicTable>(kind, eta);
        table->need_all();
    }
    return table;
}

void MaterialBuilder::finish(Principled& p, const MaterialDescription& m)
{
    auto tables = std::make_shared<PrincipledTables>();
    const std::optional<float> roughness = only_roughness(p);
    const auto need_roughness = [&](auto& table) {
        if (!roughness) return table.need_all();
        if (const float alpha = alpha_of_roughness(*roughness); alpha > 0) table.need(alpha);
    };
    const bool is_rough = !roughness || alpha_of_roughness(*roughness) > 0;
    tables->dielectric_ior = ior_of_weight(m.ior, m.specular_weight);
    const auto index = double{tables->dielectric_ior};
    tables->mean_through = static_cast<float>(mean_transmittance(index));
    if (is_rough && p.is_anisotropic()) {
        const auto need = [&](FacetKind kind, double eta) -> std::shared_ptr<const AnisotropicTable> {
            if (!roughness || !is_constant(p.anisotropy)) return wide_of(kind, eta);
            auto table = std::make_shared<AnisotropicTable>(kind, eta);
            table->need(*roughness, p.anisotropy.value);
            return table;
        };
        tables->wide_dielectric = need(FacetKind::coat, index);
        if (options_.multiscatter) tables->wide_metal = need(FacetKind::reflector, 1);
    }
    if (is_rough) {
        tables->dielectric = coat_of(tables->dielectric_ior, need_roughness);
        if (options_.multiscatter) tables->metal = reflectors(need_roughness);
    }
    if (p.coat.value > 0) {
        tables->coat_mean_through = static_cast<float>(mean_transmittance(double{m.coat_ior}));
        if (may_be_rough(p.coat_roughness))
            tables->coat = coat_of(m.coat_ior, [&](AlbedoTable& table) { need_alpha_of(table, p.coat_roughness); });
    }
    if (p.film.value > 0 && is_rough) {
        const auto filled = [&](auto film) {
            const float thickest = p.film_thickness.value;
            film->need(roughness ? *roughness : 0.05f, roughness ? *roughness : 1.0f,
                       is_constant(p.film_thickness) ? thickest : 0.0f, thickest);
            return film;
        };
        tables->film = filled(std::make_shared<FilmTable>(m.film_ior, tables->dielectric_ior));
        if (p.transmission.value > 0 && options_.multiscatter)
            tables->film_losses = filled(std::make_shared<FilmLosses>(m.film_ior, m.ior, m.thin.value_or(false)));
    }
    if (p.fuzz.value > 0) {
        if (!fuzz_) fuzz_ = std::make_shared<FuzzTable>();
        if (is_constant(p.fuzz_roughness))
            fuzz_->need(p.fuzz_roughness.value);
        else
            fuzz_->need_all();
        tables->fuzz = fuzz_;
    }
    tables->glass.ior = m.ior;
    tables->glass.tint = Color{1, 1, 1};
    tables->glass.fresnel = options_.fresnel;
    tables->glass.thin = m.thin.value_or(false);
    if (p.transmission.value > 0 && is_rough) add_losses(tables->glass, m, need_roughness);
    p.tables = tables;
}

void MaterialBuilder::finish(Interface& interface, const MaterialDescription&) { interface.fresnel = options_.fresnel; }

}  // namespace lancer
