#include "render/common_numbers.h"

#include "core/vec_lanes.h"

namespace lancer {
namespace {

// Fitted once, on statues at two resolutions: half or twice as much loses 2 % of the error or less.
constexpr float by_normal = 10;   // times the squared distance of the normals
constexpr float by_place = 0.3f;  // times that of the places, in widths of the cone

constexpr uint32_t common_branch = 1;  // of Sampler::key_of(); the pixels' own have 0

Color sum_of(const RadianceSum& a, const RadianceSum& b, const RadianceSum& c)
{
    return RadianceSum{a.r + b.r + c.r, a.g + b.g + c.g, a.b + b.b + c.b}.color();
}

// Of places that are n and p apart, for one and for eight; area: product of their widths. Not above 0 where these are
// none.
template <class T>
T kinship_of(const Vec3T<T>& n, const Vec3T<T>& p, T area)
{
    return area / ((T{} + 1.0f + dot(n, n) * by_normal) * (area + dot(p, p) * by_place));
}

// Of all pixels of a square, eight to a register; those beyond the last are like no other.
struct Lanes {
    struct Eight {
        Vec3x8 n{}, p{};
        Float8 width{};
        UInt8 material{};
    };
    std::array<Eight, square_pixels / float_lanes> eights{};
    std::array<uint32_t, square_pixels / float_lanes> tell{};  // bit i: lane i has something to tell and to hear
    std::array<Color, square_pixels> difference;               // of incident light; of those that tell

    explicit Lanes(std::span<const Found> square)
    {
        for (size_t i = 0; i < square.size(); ++i) {
            const Found& f = square[i];
            Eight& to = eights[i / float_lanes];
            const size_t lane = i % float_lanes;
            difference[i] = incident_difference(f);
            if (!(f.at.width > 0) || !is_finite(f.light) || !is_finite(difference[i])) continue;
            set_lane(to.n, lane, f.at.n), set_lane(to.p, lane, f.at.p);
            to.width[lane] = f.at.width, to.material[lane] = f.at.material;
            tell[i / float_lanes] |= 1u << lane;
        }
    }
};

// kinship() of eight with one.
Float8 kinship(const Lanes::Eight& a, const SplitVertex& b)
{
    const Vec3x8 n = a.n - Vec3x8{all_lanes(b.n.x), all_lanes(b.n.y), all_lanes(b.n.z)};
    const Vec3x8 p = a.p - Vec3x8{all_lanes(b.p.x), all_lanes(b.p.y), all_lanes(b.p.z)};
    const Float8 k = kinship_of(n, p, a.width * all_lanes(b.width));
    const Mask8 alike = (a.material == b.material) & (k > Float8{});
    return select(alike, k, Float8{});
}

}  // namespace

float kinship(const SplitVertex& a, const SplitVertex& b)
{
    if (!(a.width > 0) || !(b.width > 0) || a.material != b.material) return 0;
    const float k = kinship_of(a.n - b.n, a.p - b.p, a.width * b.width);
    return k > 0 ? k : 0;
}

Color incident_difference(const Found& f)
{
    const auto part = [](float x, float scale) { return scale > 0 ? x / scale : 0.0f; };
    const Color &d = f.difference, &scale = f.at.scale;
    return {part(d.r, scale.r), part(d.g, scale.g), part(d.b, scale.b)};
}

void begin_batch(const PathPlan& plan, const KernelSettings& settings, uint32_t width, Workspace& w)
{
    const size_t n = w.slots.size();
    if (!plan.has_common_numbers()) return w.queue.radiance.assign(n, RadianceSum{});
    w.queue.radiance.assign(3 * n, RadianceSum{});
    w.queue.split_at.assign(n, SplitVertex{});
    w.queue.common_keys.resize(n);
    for (size_t i = 0; i < n; ++i) {
        const SampleId& id = w.slots[i];
        const uint64_t square = uint64_t{id.y / PathPlan::square} * width + id.x / PathPlan::square;
        w.queue.common_keys[i] =
            Sampler::key_of(w.seed_of(settings, id.sample / plan.of_path()), square, common_branch);
    }
}

Color light_of(const Workspace& w, size_t i)
{
    const size_t n = w.slots.size();
    const std::vector<RadianceSum>& sums = w.queue.radiance;
    return sums.size() == n ? sums[i].color() : sum_of(sums[i], sums[n + i], sums[2 * n + i]);
}

Found found_of(const Workspace& w, size_t i)
{
    const size_t n = w.slots.size();
    const Color own = w.queue.radiance[n + i].color(), common = w.queue.radiance[2 * n + i].color();
    return {w.slots[i], light_of(w, i), {own.r - common.r, own.g - common.g, own.b - common.b}, w.queue.split_at[i]};
}

// With errors of variance s^2 by either numbers, those by common ones correlated by r, the best linear prediction of
// the error of a pixel's light (own + common) from the differences D of n pixels is
//     r / (2 - r) * (D_i / 2 - (sum over D) / (2 + (n - 1) r)),    Var D = 2 s^2, Cov(D_i, D_j) = r s^2,
// where D is the difference of the two means, twice that of the sums. Where pixels are more or less alike, the sums and
// n count them by kinship.
//
// So light is found + sum over j of w_ij d_j, with d the difference of the sums, and errs by (1 + w) times what own
// numbers err by less (w - 1) times what common ones do. Covariances follow from products of differences alone, whose
// mean is 0: those of common errors are d_j d_k, variances half of d_j^2.
SquareLight light_of_square(std::span<const Found> square, float likeness)
{
    SquareLight s;
    const Lanes lanes(square);
    const float gain = likeness / (2 - likeness);
    alignas(32) std::array<float, square_pixels> part{}, brightness{};
    std::array<double, square_pixels> left{};  // of d_i after what was told, by brightness; in double, as it is squared
    std::array<Vec3x8, square_pixels / float_lanes> told{};
    std::array<std::array<Float8, square_pixels>, square_pixels / float_lanes> kin;  // of those that tell, with each
    const auto tells = [&](size_t i) { return (lanes.tell[i / float_lanes] >> i % float_lanes & 1) != 0; };
    for (size_t e = 0; e < lanes.eights.size(); ++e) {
        Float8 count{};
        for (size_t j = 0; j < square.size(); ++j) {
            if (!tells(j)) continue;
            const Float8 k = kin[e][j] = kinship(lanes.eights[e], square[j].at);
            const Color& d = lanes.difference[j];
            count += k;
            told[e].x += k * d.r, told[e].y += k * d.g, told[e].z += k * d.b;
        }
        _mm256_store_ps(&part[e * float_lanes], 2.0f / (2.0f + (count - 1.0f) * likeness));
    }
    double all_left = 0;
    for (size_t i = 0; i < square.size(); ++i) {
        s.light[i] = square[i].light;
        if (!tells(i)) continue;
        const Vec3 sum = lane(told[i / float_lanes], i % float_lanes);
        const Color change = (Color{sum.x, sum.y, sum.z} * part[i] - lanes.difference[i]) * gain;
        s.light[i] += change * square[i].at.scale;
        brightness[i] = luminance(square[i].at.scale);
        left[i] = double{brightness[i]} * double{luminance(lanes.difference[i] - change)};
        all_left += left[i];
    }
    // How much each d_j counts in all pixels together, by brightness.
    std::array<Float8, square_pixels / float_lanes> in_all{};
    for (size_t e = 0; e < lanes.eights.size(); ++e)
        for (size_t i = 0; i < square.size(); ++i)
            if (tells(i)) in_all[e] += kin[e][i] * (part[i] * brightness[i]);
    double covariances = 0, squares = 0;
    for (size_t i = 0; i < square.size(); ++i) {
        if (!tells(i)) continue;
        const double d = double{luminance(lanes.difference[i])}, b = double{brightness[i]};
        const float of_others = gain * (in_all[i / float_lanes][i % float_lanes] - part[i] * brightness[i]);
        covariances += left[i] * (all_left - left[i]) + 2 * b * double{of_others} * d * d;
        squares += b * b;
    }
    if (squares > 0)  // dealt out so that no single pixel is said to have less noise than none
        for (size_t i = 0; i < square.size(); ++i)
            s.together[i] = covariances * (double{brightness[i]} * double{brightness[i]} / squares);
    return s;
}

}  // namespace lancer
