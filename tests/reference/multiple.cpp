#include "reference/multiple.h"

#include <map>
#include <mutex>
#include <tuple>

#include "reference/fresnel.h"
#include "reference/scattering.h"

namespace reference {
namespace {

// Tables are made on first use, by whichever thread needs one.
const FacetLoss& loss_of(FacetsOf what, double index, double alpha)
{
    static std::mutex mutex;
    static std::map<std::tuple<FacetsOf, double, double>, FacetLoss> all;
    const std::lock_guard lock(mutex);
    return all.try_emplace({what, index, alpha}, what, index, alpha).first->second;
}

double clear_sheet(double cos, double index, bool through)
{
    const double r = reflectance(cos, index), both = 2 * r / (1 + r);
    return through ? 1 - both : both;
}

// What comes out again of light from wo.
double albedo(FacetsOf what, double index, double alpha, Vec wo)
{
    constexpr int n = 64;
    double sum = 0;
    for (const bool through : {false, true}) {
        if (through && what == FacetsOf::metal) break;
        const bool is_sheet = what == FacetsOf::sheet;
        const Facets facets{alpha * (through && is_sheet ? std::min(1.0, 0.83 * std::abs(index - 1)) : 1)};
        for (int a = 0; a < n; ++a)
            for (int b = 0; b < n; ++b) {
                const Vec m = facets.seen_from(wo, (a + 0.5) / n, (b + 0.5) / n);
                const double cos = std::min(1.0, dot(wo, m));
                double part = 1;
                Vec wi = mirror_image(wo, m);
                if (what == FacetsOf::glass) {
                    const double r = reflectance(cos, index);
                    part = through ? 1 - r : r;
                    if (part == 0) continue;
                    if (through) wi = -refracted(wo, m, index);
                }
                if (wi.z <= 0) continue;
                if (is_sheet)
                    part =
                        std::min(clear_sheet(wo.z, index, through), clear_sheet(std::min(1.0, wi.z), index, through));
                sum += part * facets.both_seen(wo, wi) * (1 + facets.lambda(wo));
            }
    }
    return sum / (n * n);
}

// All orders but the first, relative to the light that is lost of white facets.
double further(double c, double missing) { return c * c * (1 - missing) / (1 - c * missing); }
Rgb further(Rgb c, double missing) { return {further(c.r, missing), further(c.g, missing), further(c.b, missing)}; }

}  // namespace

FacetLoss::FacetLoss(FacetsOf what, double index, double alpha)
{
    for (int i = 0; i <= steps; ++i) {
        const double cos = std::max(1e-6, std::pow(static_cast<double>(i) / steps, 2));
        loss_[static_cast<size_t>(i)] = 1 - albedo(what, index, alpha, {std::sqrt((1 - cos) * (1 + cos)), 0, cos});
    }
    mean_ = under_even_light([this](double cos) { return at(cos); });
    if (what != FacetsOf::metal)
        through_ = under_even_light([=](double cos) {
            return what == FacetsOf::sheet ? clear_sheet(cos, index, true) : 1 - reflectance(cos, index);
        });
}
double FacetLoss::at(double cos) const
{
    const double place = std::sqrt(std::min(1.0, cos)) * steps;
    const auto i = std::min(static_cast<size_t>(place), static_cast<size_t>(steps - 1));
    return loss_[i] + (loss_[i + 1] - loss_[i]) * (place - static_cast<double>(i));
}

EvenLobes even_lobes(FacetsOf what, double index, double alpha, Rgb color)
{
    EvenLobes lobes;
    lobes.here = lobes.beyond = &loss_of(what, index, alpha);
    const double missing = lobes.here->mean();
    if (what == FacetsOf::metal) {
        lobes.color = further(color, missing);
    } else if (what == FacetsOf::sheet) {
        lobes.through = lobes.here->through();
        // The tint of a sheet whose faces reflect as much as the mean.
        const double r = (1 - lobes.through) / (1 + lobes.through);
        const auto tinted = [&](double c) {
            const double passed = (1 - r) * (1 - r) * c * c / (1 - c * c * r * r);
            return c * r + c * r * passed + passed;
        };
        lobes.color = further({tinted(color.r), tinted(color.g), tinted(color.b)}, missing);
    } else {
        lobes.beyond = &loss_of(what, 1 / index, alpha);
        const double most = std::max(missing, lobes.beyond->mean());
        lobes.through = lobes.here->through() * lobes.beyond->mean() / most;
        lobes.squared = index * index;
        lobes.color = further(color, most);
    }
    return lobes;
}

Rgb EvenLobes::eval(Vec wo, Vec wi) const
{
    if (!here) return {};
    const double cos = std::abs(wi.z), lost = here->at(wo.z) * cos / pi;
    if (wi.z > 0) return color * ((1 - through) * lost * here->at(cos) / here->mean());
    return color * (through * lost * beyond->at(cos) / (beyond->mean() * squared));
}

}  // namespace reference
