// A thin film on the clear part of a principled material: what it makes of each lobe of glass.
#include "materials/principled.h"
#include "materials/principled_bsdf.h"
#include "materials/thin_film.h"

namespace lancer {
namespace {

constexpr Color whole{1, 1, 1};

Color over(Color a, Color b) { return {a.r / b.r, a.g / b.g, a.b / b.b}; }

}  // namespace

// What a film makes of the light that smooth glass, or a facet, reflects or lets through, as a factor. cos: at the
// facet, on the side of wo.
Color PrincipledBsdf::film_on_glass(double cos, bool through) const
{
    const GlassBsdf& g = glass;
    const Fresnel f = fresnel_dielectric(std::min(1.0, cos), (1 - cos) * (1 + cos), g.eta);
    if (!(film > 0) || !(f.reflectance > 0 && f.reflectance < 1)) return whole;
    const Color with = film_on_boundary(f, cos);
    if (g.thin)
        return part_of_sheets(with, through) / static_cast<float>(part_of_sheet(double{f.reflectance}, through));
    return through ? complement(with) / (1 - f.reflectance) : with / f.reflectance;
}

// The reflectance of a boundary with the film.
Color PrincipledBsdf::film_on_boundary(const Fresnel& bare, double cos) const
{
    const GlassBsdf& g = glass;
    const bool is_denser = g.eta >= 1;  // beyond
    const auto outside = static_cast<float>(is_denser ? cos : static_cast<double>(bare.cos_t));
    const auto n = static_cast<float>(is_denser ? g.eta : 1 / g.eta);
    const float r = bare.reflectance;
    return mix(Color{r, r, r}, ThinFilm{film_ior, film_thickness}.on_dielectric(outside, n), film);
}

// They are those of the material's own index: at other media the lobes are as without a film.
FilmLosses::At PrincipledBsdf::losses_of_film() const
{
    const PrincipledTables& tables = *material->tables;
    const float own = tables.glass.ior, there = ShadingPoint{.front = front, .eta = media_eta}.inner_over_outer(own);
    if (!tables.film_losses || !(std::abs(there - own) <= own * 0x1p-20f) || !glass.multiple) return {};
    return tables.film_losses->at(roughness, film_thickness);
}

// What a film makes of the light of a rough sheet, which is that of wo or wi, whichever is less.
Color PrincipledBsdf::sheet_with_film(Vec3d o, Vec3d i, bool through) const
{
    const GlassBsdf& g = glass;
    const auto bare = [&](double cos) { return fresnel_dielectric(std::min(1.0, cos), (1 - cos) * (1 + cos), g.eta); };
    const Fresnel of_o = bare(o.z), of_i = bare(std::abs(i.z));
    const auto with = [&](const Fresnel& f, double cos) {
        if (!(f.reflectance < 1)) return part_of_sheets(whole, through);
        return part_of_sheets(film_on_boundary(f, cos), through);
    };
    const auto without = [&](const Fresnel& f) { return part_of_sheet(double{f.reflectance}, through); };
    const double less = std::min(without(of_o), without(of_i));
    if (!(less > 0)) return whole;
    return least_of(with(of_o, o.z), with(of_i, std::abs(i.z))) / static_cast<float>(less);
}

// Of multiple scattering: the lobes of GlassLobes, with losses, means and T by channel, from which those of the bare
// part differ. Without colours.
Color PrincipledBsdf::further_with_film(const Seen& s, Vec3 wi) const
{
    const GlassBsdf& g = glass;
    const GlassLobes& bare = g.multiple;
    const bool through = wi.z < 0;
    const uint32_t side_o = !g.thin && g.eta < 1 ? 1 : 0, side_beyond = g.thin ? 0 : 1 - side_o;
    const auto mixed = [&](float without, Color with) { return mix(Color{without, without, without}, with, film); };
    const Color here = mixed(bare.here.mean(), film_losses.mean(side_o));
    const Color beyond = mixed(bare.beyond.mean(), film_losses.mean(side_beyond));
    const Color all{std::max(here.r, beyond.r), std::max(here.g, beyond.g), std::max(here.b, beyond.b)};
    // What smooth ones let through, from wo's side.
    const float most = std::max(bare.here.mean(), bare.beyond.mean()),
                bare_through = bare.part_through * most / bare.beyond.mean();
    const auto eta = static_cast<float>(g.eta);
    const Color sent = mixed(bare_through, film_losses.through() * (side_o == 1 ? eta * eta : 1));
    const auto cos_o = static_cast<float>(s.o.z), cos_i = static_cast<float>(std::abs(unit_in_double(wi).z));
    const Color lost = mixed(bare.here.loss(cos_o), film_losses.loss(side_o, cos_o));
    const AlbedoTable::EvenLobe& other = through ? bare.beyond : bare.here;
    const Color lost_i = mixed(other.loss(cos_i), film_losses.loss(through ? side_beyond : side_o, cos_i));
    const Color part_through = g.thin ? sent : over(sent * beyond, all);
    const Color lobe =
        through ? over(part_through, beyond) * (g.thin ? 1 : 1 / (eta * eta)) : over(complement(part_through), here);
    return bare.color * lost * lost_i * lobe * (cos_i / pi);
}

}  // namespace lancer
