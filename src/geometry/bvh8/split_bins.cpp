#include "geometry/bvh8/split_bins.h"

#include <cmath>
#include <optional>

namespace lancer {
namespace {

Float4 in_register(Vec3 p) { return Float4{p.x, p.y, p.z, 0}; }

// Sweeps over the planes between bins. below[k], above[k]: number of references on either side of plane k.
template <class Accept>
void sweep(std::span<const Box4> boxes, std::span<const uint32_t> entering, std::span<const uint32_t> leaving, int axis,
           Division& best, const Accept& accept)
{
    const size_t bins = boxes.size();
    std::array<Box4, max_bins> above;
    std::array<uint32_t, max_bins> count_above{};
    Box4 box;
    uint32_t count = 0;
    for (size_t k = bins - 1; k > 0; --k) {
        box.grow(boxes[k]);
        above[k] = box;
        count_above[k] = count += leaving[k];
    }
    box = {}, count = 0;
    for (size_t k = 1; k < bins; ++k) {
        box.grow(boxes[k - 1]);
        count += entering[k - 1];
        if (!accept(count, count_above[k])) continue;
        const float cost =
            box.half_area() * static_cast<float>(count) + above[k].half_area() * static_cast<float>(count_above[k]);
        if (cost < best.cost) best = {cost, axis, static_cast<int>(k), count, count_above[k], box, above[k]};
    }
}

}  // namespace

ObjectBins::ObjectBins(const Spread& spread, size_t count)
    : bins_(static_cast<int>(std::min<size_t>(max_bins, 4 + count / 2))), origin_(spread.centers.lower)
{
    const Float4 extent = spread.centers.upper - origin_;
    // Slightly less than the number of bins, so that the last centre stays in the last bin.
    const Float4 scale = 0.999f * static_cast<float>(bins_) / extent;
    scale_ = select(extent > 0.0f, scale, Float4{});
}

void ObjectBins::add(const ObjectBins& b)
{
    for (size_t axis = 0; axis < 3; ++axis)
        for (size_t k = 0; k < max_bins; ++k) {
            boxes_[axis][k].grow(b.boxes_[axis][k]);
            counts_[axis][k] += b.counts_[axis][k];
        }
}

Division ObjectBins::best() const
{
    Division best;
    const auto n = static_cast<size_t>(bins_);
    for (size_t axis = 0; axis < 3; ++axis) {
        if (!(scale_[axis] > 0)) continue;
        const auto counts = std::span(counts_[axis]).first(n);
        sweep(std::span(boxes_[axis]).first(n), counts, counts, static_cast<int>(axis), best,
              [](uint32_t below, uint32_t above) { return below > 0 && above > 0; });
    }
    return best;
}

SpaceBins::SpaceBins(const Box4& box)
    : origin_(box.lower), width_((box.upper - box.lower) / static_cast<float>(max_bins)), scale_(1.0f / width_)
{
    for (size_t k = 0; k < 3; ++k) {
        const float far = std::max(std::abs(float{box.lower[k]}), std::abs(float{box.upper[k]}));
        usable_[k] = width_[k] > gamma(16) * far && std::isfinite(width_[k]) && std::isfinite(scale_[k]);
    }
}

void SpaceBins::add(const TriangleSet& triangles, const Reference& r)
{
    const auto first = bins_of(r.box.lower), last = bins_of(r.box.upper);
    std::optional<Corners> triangle;
    for (size_t axis = 0; axis < 3; ++axis) {
        if (!usable_[axis]) continue;
        const auto from = static_cast<size_t>(first[axis]), to = static_cast<size_t>(last[axis]);
        ++enter_[axis][from];
        ++leave_[axis][to];
        if (from == to) {
            boxes_[axis][from].grow(r.box);
            continue;
        }
        if (!triangle) triangle = triangles.corners(r.number());
        add_parts(axis, *triangle, r, first[axis], last[axis]);
    }
}

// The part of the triangle in each bin: its corners, and where its edges cross the planes between bins.
void SpaceBins::add_parts(size_t axis, const Corners& triangle, const Reference& r, int first, int last)
{
    std::array<Box4, max_bins + 2> parts;  // of bins from -1 on
    const auto part = [&](int bin) -> Box4& { return parts[static_cast<size_t>(bin + 1)]; };
    const auto bin_about = [&](float x) {
        return static_cast<int>(std::clamp((x - origin_[axis]) * scale_[axis], static_cast<float>(first) - 0.5f,
                                           static_cast<float>(last) + 1.5f) +
                                1) -
               1;
    };
    const std::array corners{in_register(triangle[0]), in_register(triangle[1]), in_register(triangle[2])};
    for (size_t k = 0; k < 3; ++k) {
        Float4 a = corners[k], b = corners[(k + 1) % 3];
        part(bin_about(a[axis])).grow(a);
        if (a[axis] > b[axis]) std::swap(a, b);
        const Float4 slope = (b - a) / (b[axis] - a[axis]);
        for (int bin = bin_about(a[axis]) + 1, to = bin_about(b[axis]); bin <= to; ++bin) {
            const Float4 crossing = a + slope * (plane(axis, bin) - a[axis]);
            part(bin - 1).grow(crossing);
            part(bin).grow(crossing);
        }
    }
    for (int bin = first; bin <= last; ++bin) {
        const Box4 inside = overlap(part(bin), r.box);
        if (!inside.empty()) boxes_[axis][static_cast<size_t>(bin)].grow(inside);
    }
}

void SpaceBins::add(const SpaceBins& b)
{
    for (size_t axis = 0; axis < 3; ++axis)
        for (size_t k = 0; k < max_bins; ++k) {
            boxes_[axis][k].grow(b.boxes_[axis][k]);
            enter_[axis][k] += b.enter_[axis][k];
            leave_[axis][k] += b.leave_[axis][k];
        }
}

Division SpaceBins::best(float cost, size_t count, size_t room) const
{
    Division best;
    best.cost = cost;
    for (size_t axis = 0; axis < 3; ++axis) {
        if (!usable_[axis]) continue;
        Division d;
        sweep(boxes_[axis], enter_[axis], leave_[axis], static_cast<int>(axis), d,
              [&](uint32_t below, uint32_t above) { return below > 0 && above > 0 && below < count && above < count; });
        if (d.cost < best.cost && d.count_below + d.count_above <= count + room) best = d;
    }
    return best;
}

}  // namespace lancer
