// Binning for the surface area heuristic, over box centres (Wald, "On fast Construction of SAH-based Bounding Volume
// Hierarchies", 2007) and over space, where a reference that crosses the plane goes to both sides (Stich, Friedrich,
// Dietrich, "Spatial Splits in Bounding Volume Hierarchies", HPG 2009).
#pragma once

#include <algorithm>
#include <span>

#include "geometry/bvh8/split_reference.h"
#include "geometry/triangle_set.h"

namespace lancer {

inline constexpr int max_bins = 16;

// A division into the bins before `bin` and from it on. Cost: number of references times area of their box, summed over
// both sides.
struct Division {
    float cost = FloatBox::inf;
    int axis = -1, bin = 0;
    uint32_t count_below = 0, count_above = 0;
    Box4 below, above;

    explicit operator bool() const { return axis >= 0; }
};

// The box of references and of their centres, in doubled coordinates.
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

// Bins of centres along all axes. Bins of parts of a set can be added in any order.
class ObjectBins {
public:
    // count: expected number of references; few need few bins.
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
    // None if all centres are equal.
    Division best() const;
    bool is_below(const Division& d, const Reference& r) const
    {
        return bins_of(r)[static_cast<size_t>(d.axis)] < d.bin;
    }

private:
    std::array<int, 4> bins_of(const Reference& r) const
    {
        const Int4 k = truncate((r.box.lower + r.box.upper - origin_) * scale_);
        std::array<int, 4> bins;
        store4(bins.data(), min(max(k, Int4{}), Int4{} + (bins_ - 1)));
        return bins;
    }

    int bins_;
    Float4 origin_, scale_;  // scale: 0 for axes along which all centres are equal
    std::array<std::array<Box4, max_bins>, 3> boxes_;
    std::array<std::array<uint32_t, max_bins>, 3> counts_{};
};

// Bins of space along all axes.
class SpaceBins {
public:
    explicit SpaceBins(const Box4& box);

    void add(const TriangleSet& triangles, const Reference& r);
    void add(const SpaceBins& b);
    // The best division with a lower cost that leaves fewer than all `count` references on each side and adds at most
    // `room` references. The counts are upper bounds.
    Division best(float cost, size_t count, size_t room) const;

    // The sides to which a reference belongs, and the plane.
    bool ends_below(const Division& d, const Reference& r) const { return bins_of(r.box.upper)[at(d)] < d.bin; }
    bool starts_above(const Division& d, const Reference& r) const { return bins_of(r.box.lower)[at(d)] >= d.bin; }
    float plane(const Division& d) const { return plane(at(d), d.bin); }

private:
    static size_t at(const Division& d) { return static_cast<size_t>(d.axis); }
    // Undefined for axes that are not usable.
    std::array<int, 4> bins_of(Float4 p) const
    {
        const Float4 last{max_bins - 1, max_bins - 1, max_bins - 1, max_bins - 1};
        std::array<int, 4> bins;
        store4(bins.data(), truncate(min(max((p - origin_) * scale_, Float4{}), last)));
        return bins;
    }
    float plane(size_t axis, int bin) const { return origin_[axis] + width_[axis] * static_cast<float>(bin); }
    void add_parts(size_t axis, const Corners& triangle, const Reference& r, int first, int last);

    Float4 origin_, width_, scale_;
    std::array<bool, 3> usable_;  // whether the bins are wider than the resolution of float
    std::array<std::array<Box4, max_bins>, 3> boxes_;
    std::array<std::array<uint32_t, max_bins>, 3> enter_{},
        leave_{};  // number of references that begin and end in each bin
};

}  // namespace lancer
