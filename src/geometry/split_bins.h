// How a builder finds where to divide a set of references: by the surface area heuristic over bins, of the centres of
// boxes (Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007) or of space itself, where a
// reference that crosses the plane goes to both sides (Stich, Friedrich, Dietrich, "Spatial Splits in Bounding Volume
// Hierarchies", HPG 2009).
#pragma once

#include <algorithm>
#include <span>

#include "geometry/split_reference.h"

namespace lancer {

inline constexpr int max_bins = 16;

// Cost: number of references times area of their box, of both sides. Sides are the bins before and from `bin` on.
struct Division {
    float cost = FloatBox::inf;
    int axis = -1, bin = 0;
    uint32_t count_below = 0, count_above = 0;
    Box4 below, above;

    explicit operator bool() const { return axis >= 0; }
};

// The box of references and that of their centres, in doubled coordinates.
struct Spread {
    Box4 box, centers;

    void add(const Reference& r)
    {
        box.grow(r.box);
        centers.grow(r.box.lower + r.box.upper);
    }
    void add(const Spread& s)
    {
        box.grow(s.box);
        centers.grow(s.centers);
    }
};

// Bins of centres, of all axes at once. Those of parts of a set can be added up, in any order.
class ObjectBins {
public:
    // count: of references that there will be; few need few bins.
    ObjectBins(const Spread& spread, size_t count);

    void add(const Reference& r)
    {
        const auto k = bins_of(r);
        for (size_t axis = 0; axis < 3; ++axis) {
            boxes_[axis][k[axis]].grow(r.box);
            ++counts_[axis][k[axis]];
        }
    }
    void add(const ObjectBins& b);
    // None where all centres are one.
    Division best() const;
    bool is_below(const Division& d, const Reference& r) const
    {
        return bins_of(r)[static_cast<size_t>(d.axis)] < d.bin;
    }

private:
    std::array<int, 4> bins_of(const Reference& r) const
    {
        const __m128i last = _mm_set1_epi32(bins_ - 1);
        const __m128i k = _mm_cvttps_epi32((r.box.lower + r.box.upper - origin_) * scale_);
        std::array<int, 4> bins;
        _mm_storeu_si128(reinterpret_cast<__m128i*>(bins.data()),
                         _mm_min_epi32(_mm_max_epi32(k, _mm_setzero_si128()), last));
        return bins;
    }

    int bins_;
    Float4 origin_, scale_;  // scale: 0 of axes along which all centres are one
    std::array<std::array<Box4, max_bins>, 3> boxes_;
    std::array<std::array<uint32_t, max_bins>, 3> counts_{};
};

// Bins of space along one axis.
class SpaceBins {
public:
    SpaceBins(const Box4& box, int axis);

    // Whether the bins are wider than what float can tell apart.
    bool usable() const { return usable_; }
    void add(const Corners& triangle, const Reference& r);
    void add(const SpaceBins& b);
    // Of those that leave fewer than `count` references on either side. The counts are upper bounds.
    Division best(size_t count) const;

    // Of a division along this axis: which sides a reference goes to, and the plane.
    bool ends_below(const Division& d, const Reference& r) const { return bin_of(r.box.upper[axis_]) < d.bin; }
    bool starts_above(const Division& d, const Reference& r) const { return bin_of(r.box.lower[axis_]) >= d.bin; }
    float plane(int bin) const { return origin_ + width_ * static_cast<float>(bin); }

private:
    int bin_of(float x) const
    {
        return static_cast<int>(std::clamp((x - origin_) * scale_, 0.0f, static_cast<float>(max_bins - 1)));
    }

    size_t axis_;
    float origin_, width_, scale_;
    bool usable_;
    std::array<Box4, max_bins> boxes_;
    std::array<uint32_t, max_bins> enter_{}, leave_{};  // how many begin and end in each bin
};

}  // namespace lancer
