#include "geometry/split_bins.h"

#include <cmath>

namespace lancer {
namespace {

Float4 in_register(Vec3 p) { return Float4{p.x, p.y, p.z, 0}; }

// Sweeps over the planes between bins. below[k], above[k]: how many references count for either side of plane k.
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
    // A little less than the number of bins, so that the last centre stays in the last.
    const Float4 scale = 0.999f * static_cast<float>(bins_) / extent;
    scale_ = _mm_and_ps(scale, _mm_cmpgt_ps(extent, Float4{}));
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

SpaceBins::SpaceBins(const Box4& box, int axis)
    : axis_(static_cast<size_t>(axis)),
      origin_(box.lower[axis_]),
      width_((box.upper[axis_] - origin_) / max_bins),
      scale_(1 / width_),
      usable_(width_ > gamma(16) * std::max(std::abs(origin_), std::abs(static_cast<float>(box.upper[axis_]))) &&
              std::isfinite(width_) && std::isfinite(scale_))
{
}

void SpaceBins::add(const Corners& triangle, const Reference& r)
{
    const int first = bin_of(r.box.lower[axis_]), last = bin_of(r.box.upper[axis_]);
    const auto at = [](auto& bins, int k) -> auto& { return bins[static_cast<size_t>(k)]; };
    ++at(enter_, first);
    ++at(leave_, last);
    if (first == last) {
        at(boxes_, first).grow(r.box);
        return;
    }
    // Which part of the triangle lies in each bin: its corners, and where its edges cross the planes between bins.
    std::array<Box4, max_bins + 2> parts;  // of bins from -1 on
    const auto bin_about = [&](float x) {
        return static_cast<int>(std::clamp((x - origin_) * scale_, static_cast<float>(first) - 0.5f,
                                           static_cast<float>(last) + 1.5f) +
                                1) -
               1;
    };
    const std::array corners{in_register(triangle[0]), in_register(triangle[1]), in_register(triangle[2])};
    for (size_t k = 0; k < 3; ++k) {
        Float4 a = corners[k], b = corners[(k + 1) % 3];
        at(parts, bin_about(a[axis_]) + 1).grow(a);
        if (a[axis_] > b[axis_]) std::swap(a, b);
        const Float4 slope = (b - a) / (b[axis_] - a[axis_]);
        for (int bin = bin_about(a[axis_]) + 1, to = bin_about(b[axis_]); bin <= to; ++bin) {
            const Float4 crossing = a + slope * (plane(bin) - a[axis_]);
            at(parts, bin).grow(crossing);
            at(parts, bin + 1).grow(crossing);
        }
    }
    for (int bin = first; bin <= last; ++bin) {
        const Box4 part = overlap(at(parts, bin + 1), r.box);
        if (!part.empty()) at(boxes_, bin).grow(part);
    }
}

void SpaceBins::add(const SpaceBins& b)
{
    for (size_t k = 0; k < max_bins; ++k) {
        boxes_[k].grow(b.boxes_[k]);
        enter_[k] += b.enter_[k];
        leave_[k] += b.leave_[k];
    }
}

Division SpaceBins::best(size_t count) const
{
    Division best;
    sweep(boxes_, enter_, leave_, static_cast<int>(axis_), best,
          [&](uint32_t below, uint32_t above) { return below > 0 && above > 0 && below < count && above < count; });
    return best;
}

}  // namespace lancer
