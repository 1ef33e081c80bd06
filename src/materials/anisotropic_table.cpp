#include "materials/anisotropic_table.h"

#include "materials/fresnel.h"

namespace lancer {
namespace {

constexpr uint32_t all_roughnesses = 12, all_anisotropies = 9;

struct PlaceInRange {
    uint32_t index;
    float part;
};
// x: in [0, 1].
PlaceInRange place_in(float x, uint32_t nodes)
{
    if (nodes == 1) return {0, 0};
    const float at = std::clamp(x, 0.0f, 1.0f) * static_cast<float>(nodes - 1);
    const uint32_t index = std::min(static_cast<uint32_t>(at), nodes - 2);
    return {index, at - static_cast<float>(index)};
}

// Albedo over that of the smooth surface, subtracted from 1.
template <class F>
double loss_of_stretched(const StretchedGgx& ggx, Vec3d wo, const F& reflectance)
{
    constexpr int turns = 24, heights = 24;
    const double smooth = reflectance(wo.z);
    if (!(smooth > 0)) return 0;
    double sum = 0, weights = 0;
    for (int j = 0; j < heights; ++j) {
        const double s = (j + 0.5) / heights, weight = s * (1 - s), v = s * s * (3 - 2 * s);
        for (int i = 0; i < turns; ++i) {
            const Vec3d h = ggx.sample_visible(wo, {(static_cast<float>(i) + 0.5f) / turns, static_cast<float>(v)});
            const Vec3d wi = mirrored(wo, h);
            weights += weight;
            if (!(wi.z > 0)) continue;
            const FacetReflection f = eval_stretched(ggx, wo, wi);
            sum += weight * (f.f_cos / f.pdf) * (reflectance(std::min(1.0, dot(wo, h))) / smooth);
        }
    }
    return 1 - sum / weights;
}

}  // namespace

float AnisotropicTable::Slice::at(float cos, float x, float y) const
{
    const auto [c, part] = place_in(std::sqrt(std::clamp(cos, 0.0f, 1.0f)), cosines);
    const float azimuth = x == 0 && y == 0 ? 0 : std::atan2(std::abs(y), std::abs(x)) * (2 / pi);
    const auto [a, side] = place_in(azimuth, azimuths);
    const float* low = &loss[c * azimuths + a];
    const float here = low[0] + side * (low[1] - low[0]),
                there = low[azimuths] + side * (low[azimuths + 1] - low[azimuths]);
    return here + part * (there - here);
}

AnisotropicTable::Slice AnisotropicTable::make(float roughness, float anisotropy) const
{
    const auto reflectance = [&](double cos) {
        if (kind_ != FacetKind::coat) return 1.0;
        return fresnel_dielectric_double(std::min(1.0, cos), (1 - cos) * (1 + cos), eta_).reflectance;
    };
    const AlphaPair alpha = alphas_of(roughness, anisotropy);
    const StretchedGgx ggx{double{alpha.along}, double{alpha.across}};
    Slice slice;
    const auto direction = [](double cos, double turn) {
        const double r = std::sqrt((1 - cos) * (1 + cos)), phi = 0.5 * pi_d * turn;
        return Vec3d{r * std::cos(phi), r * std::sin(phi), cos};
    };
    for (uint32_t c = 0; c < cosines; ++c)
        for (uint32_t a = 0; a < azimuths; ++a) {
            const double root = std::max(2e-3, static_cast<double>(c) / (cosines - 1));
            const Vec3d wo = direction(root * root, static_cast<double>(a) / (azimuths - 1));
            slice.loss[c * azimuths + a] = static_cast<float>(loss_of_stretched(ggx, wo, reflectance));
        }
    // Under even light, of the interpolated losses.
    constexpr int steps = 96;
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double cos = std::sqrt((i + 0.5) / steps);
            const Vec3 w = to_float(direction(cos, (j + 0.5) / steps));
            const double r = reflectance(cos);
            sum += (1 - r) + r * static_cast<double>(slice.at(w.z, w.x, w.y));
        }
    slice.mean = static_cast<float>(sum / (steps * steps));
    return slice;
}

void AnisotropicTable::need(float roughness, float anisotropy)
{
    if (slices_.empty()) slices_.push_back(make(roughness, anisotropy));
}

void AnisotropicTable::need_all()
{
    roughnesses_ = all_roughnesses, anisotropies_ = all_anisotropies;
    slices_.clear();
    for (uint32_t r = 0; r < roughnesses_; ++r)
        for (uint32_t a = 0; a < anisotropies_; ++a)
            slices_.push_back(make(std::max(0.02f, static_cast<float>(r) / (all_roughnesses - 1)),
                                   static_cast<float>(a) / (all_anisotropies - 1)));
}

AnisotropicTable::At AnisotropicTable::at(float roughness, float anisotropy) const
{
    const auto [r, rough] = place_in(roughness, roughnesses_);
    const auto [a, stretched] = place_in(anisotropy, anisotropies_);
    const uint32_t next_r = std::min(r + 1, roughnesses_ - 1), next_a = std::min(a + 1, anisotropies_ - 1);
    At at;
    at.slices_ = {&slices_[r * anisotropies_ + a], &slices_[r * anisotropies_ + next_a],
                  &slices_[next_r * anisotropies_ + a], &slices_[next_r * anisotropies_ + next_a]};
    at.rough_ = rough, at.stretched_ = stretched;
    return at;
}

float AnisotropicTable::At::loss(Vec3 w) const
{
    if (rough_ == 0 && stretched_ == 0) return slices_[0]->at(w.z, w.x, w.y);
    const auto of = [&](size_t i) { return slices_[i]->at(w.z, w.x, w.y); };
    return lancer::mix(lancer::mix(of(0), of(1), stretched_), lancer::mix(of(2), of(3), stretched_), rough_);
}

float AnisotropicTable::At::mean_missing() const
{
    const auto of = [&](size_t i) { return slices_[i]->mean; };
    return lancer::mix(lancer::mix(of(0), of(1), stretched_), lancer::mix(of(2), of(3), stretched_), rough_);
}

}  // namespace lancer
