#include "materials/glass_losses.h"

#include <algorithm>
#include <cmath>

#include "materials/fresnel.h"
#include "materials/thin_sheet.h"

namespace lancer {
namespace {

double mean_through_sheet(double eta)
{
    return cosine_mean([=](double cos) {
        return part_of_sheet(fresnel_dielectric_double(cos, (1 - cos) * (1 + cos), eta).reflectance, true);
    });
}

Color further_orders(Color c, float missing)
{
    return {all_further_orders(c.r, missing), all_further_orders(c.g, missing), all_further_orders(c.b, missing)};
}

}  // namespace

GlassLosses::GlassLosses(float ior, bool thin) : ior_(ior), thin_(thin) { add(static_cast<double>(ior)); }

void GlassLosses::add(double eta)
{
    const FacetKind kind = thin_ ? FacetKind::sheet : FacetKind::boundary;
    fill(boundaries_.emplace_back(Boundary{AlbedoTable(kind, eta), AlbedoTable(kind, 1 / eta), eta,
                                           thin_ ? mean_through_sheet(eta) : mean_transmittance(eta)}));
}

void GlassLosses::fill(Boundary& b) const
{
    for (AlbedoTable* table : {&b.outer, &b.inner}) {
        if (thin_ && table == &b.inner) break;  // a sheet is the same from both sides
        if (all_) table->need_all();
        for (const float alpha : alphas_) table->need(alpha);
    }
}

void GlassLosses::need(float alpha)
{
    if (std::find(alphas_.begin(), alphas_.end(), alpha) != alphas_.end()) return;
    alphas_.push_back(alpha);
    for (Boundary& b : boundaries_) fill(b);
}

void GlassLosses::need_all()
{
    all_ = true;
    for (Boundary& b : boundaries_) fill(b);
}

void GlassLosses::touch(float outer_ior)
{
    const double eta = static_cast<double>(ior_ / outer_ior);
    const auto is_known = [=](const Boundary& b) { return b.eta == eta; };
    if (thin_ || std::any_of(boundaries_.begin(), boundaries_.end(), is_known)) return;
    add(eta);
}

GlassLobes GlassLosses::lobes(double eta, bool front, float alpha, Color tint) const
{
    return thin_ ? lobes_of_sheet(alpha, tint) : lobes_of_body(eta, front, alpha, tint);
}

GlassLobes GlassLosses::lobes_of_body(double eta, bool front, float alpha, Color tint) const
{
    const double inner_over_outer = front ? eta : 1 / eta;
    const auto distance = [=](const Boundary& b) { return std::abs(std::log(b.eta / inner_over_outer)); };
    const Boundary* boundary = &boundaries_.front();
    for (const Boundary& b : boundaries_)
        if (boundaries_.size() > 1 && distance(b) < distance(*boundary)) boundary = &b;
    const AlbedoTable& near = front ? boundary->outer : boundary->inner;
    const AlbedoTable& far = front ? boundary->inner : boundary->outer;
    const AlbedoTable::EvenLobe here = near.even_lobe(alpha), beyond = far.even_lobe(alpha);
    if (!here || !beyond) return {};
    const float missing = here.mean(), missing_beyond = beyond.mean(), most = std::max(missing, missing_beyond);
    // Of what goes through, energy is `common` from the outside and over the squared index from the inside; radiance
    // shrinks by the square of the index beyond over the one before.
    const double squared = boundary->eta * boundary->eta, common = boundary->through / static_cast<double>(most);
    const auto through = static_cast<float>((front ? common : common / squared) * static_cast<double>(missing_beyond));
    return {.here = here,
            .beyond = beyond,
            .color = further_orders(tint, most),
            .reflected = (1 - through) / missing,
            .transmitted = static_cast<float>(front ? common / squared : common),
            .part_through = through};
}

GlassLobes GlassLosses::lobes_of_sheet(float alpha, Color tint) const
{
    const Boundary& sheet = boundaries_.front();
    const AlbedoTable::EvenLobe lobe = sheet.outer.even_lobe(alpha);
    if (!lobe) return {};
    const float missing = lobe.mean();
    // The reflectance of a face that lets as much through.
    const auto through = static_cast<float>(sheet.through);
    const SheetColors colors = colors_of_sheet((1 - sheet.through) / (1 + sheet.through), tint);
    return {.here = lobe,
            .beyond = lobe,
            .color = further_orders(colors.reflected * (1 - through) + colors.transmitted * through, missing),
            .reflected = (1 - through) / missing,
            .transmitted = through / missing,
            .part_through = through};
}

}  // namespace lancer
