#include "render/kinship.h"

#include "core/lanes/vec.h"

namespace lancer {
namespace {

// Fitted once, on cornell and statues at three resolutions: half or twice as much leaves up to 4 % more of the error.
constexpr float by_normal = 20;    // times the squared distance of the normals
constexpr float by_place = 0.01f;  // times that of the places, in widths of the cone
// A place of which pivots tell so much already is no pivot. Less leaves more pivots, and these cost time.
constexpr float told_enough = 0.8f;
// From one candidate to the next, so that the first few lie far apart: odd, to meet all.
constexpr size_t stride = 27;

// Of places that are n and p apart, for one and for eight; area: product of their widths. Not above 0 where these are
// none.
template <class T>
T kinship_of(const Vec3T<T>& n, const Vec3T<T>& p, T area)
{
    return area / (area * (T{} + 1.0f + dot(n, n) * by_normal) + dot(p, p) * by_place);
}

// All places of a square, eight to a register.
struct Places {
    struct Eight {
        Vec3x8 n{}, p{};
        Float8 width{};
        UInt8 material{};
    };
    std::array<Eight, square_pixels / float_lanes> eights{};

    void set(size_t i, const SplitVertex& at)
    {
        Eight& to = eights[i / float_lanes];
        const size_t lane = i % float_lanes;
        set_lane(to.n, lane, at.n), set_lane(to.p, lane, at.p);
        to.width[lane] = at.width, to.material[lane] = at.material;
    }
};

// kinship() of eight with one.
Float8 kinship(const Places::Eight& a, const SplitVertex& b)
{
    const Vec3x8 n = a.n - all_lanes(b.n);
    const Vec3x8 p = a.p - all_lanes(b.p);
    const Float8 k = kinship_of(n, p, a.width * all_lanes(b.width));
    return select((a.material == b.material) & (k > Float8{}), k, Float8{});
}

float dot(const OfSquare& a, const OfSquare& b)
{
    Float8 sum = a.eight(0) * b.eight(0);
    for (size_t e = 1; e < OfSquare::eights; ++e) sum += a.eight(e) * b.eight(e);
    const Float4 four = lower(sum) + upper(sum);
    return (four[0] + four[2]) + (four[1] + four[3]);
}

// v -= a * by
void subtract(OfSquare& v, const OfSquare& a, float by)
{
    for (size_t e = 0; e < OfSquare::eights; ++e) v.set_eight(e, v.eight(e) - a.eight(e) * by);
}

}  // namespace

float kinship(const SplitVertex& a, const SplitVertex& b)
{
    if (!(a.width > 0) || !(b.width > 0) || a.material != b.material) return 0;
    const float k = kinship_of(a.n - b.n, a.p - b.p, a.width * b.width);
    return k > 0 ? k : 0;
}

KinInverse::KinInverse(std::span<const Found> square, const std::array<bool, square_pixels>& takes_part)
{
    Places places;
    OfSquare left;  // of the diagonal of K, by what pivots do not tell
    for (size_t i = 0; i < square.size(); ++i)
        if (takes_part[i]) places.set(i, square[i].at), left[i] = 1;
    for (size_t k = 0; k < square_pixels && pivots_ < most_pivots; ++k) {
        const size_t pivot = k * stride % square_pixels;
        const float of_pivot = left[pivot];
        if (!(of_pivot > 1 - told_enough)) continue;
        OfSquare& x = columns_[pivots_];
        for (size_t e = 0; e < OfSquare::eights; ++e) x.set_eight(e, kinship(places.eights[e], square[pivot].at));
        for (size_t j = 0; j < pivots_; ++j) subtract(x, columns_[j], columns_[j][pivot]);
        const float scale = 1 / sqrt(of_pivot);
        for (size_t e = 0; e < OfSquare::eights; ++e) {
            const Float8 told = x.eight(e) * scale;
            x.set_eight(e, told);
            left.set_eight(e, larger(left.eight(e) - told * told, Float8{}));
        }
        ++pivots_;
    }
    // Sherman and Morrison's formula, pivot by pivot: (M + r x x^T)^-1 = M^-1 - y y^T r / (1 + r x^T y), y = M^-1 x.
    for (size_t e = 0; e < OfSquare::eights; ++e) own_.set_eight(e, 1.0f / ((2 - likeness) + left.eight(e) * likeness));
    const size_t all = pivots_;
    for (pivots_ = 0; pivots_ < all; ++pivots_) {
        OfSquare& x = columns_[pivots_];
        const OfSquare y = times(x);
        const float scale = sqrt(likeness / (1 + likeness * dot(x, y)));
        for (size_t e = 0; e < OfSquare::eights; ++e) x.set_eight(e, y.eight(e) * scale);
    }
}

OfSquare KinInverse::times(const OfSquare& v) const
{
    OfSquare result;
    for (size_t e = 0; e < OfSquare::eights; ++e) result.set_eight(e, own_.eight(e) * v.eight(e));
    for (size_t k = 0; k < pivots_; ++k) subtract(result, columns_[k], dot(columns_[k], v));
    return result;
}

OfSquare KinInverse::diagonal() const
{
    OfSquare result = own_;
    for (size_t k = 0; k < pivots_; ++k)
        for (size_t e = 0; e < OfSquare::eights; ++e)
            result.set_eight(e, result.eight(e) - columns_[k].eight(e) * columns_[k].eight(e));
    return result;
}

}  // namespace lancer
