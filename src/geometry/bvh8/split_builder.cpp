#include "geometry/bvh8/split_builder.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/bvh8/split_bins.h"

namespace lancer {
namespace {

constexpr double duplicates = 0.4;  // references that spatial splits may add, for each triangle
// Spatial splits are tried if the boxes of the object split overlap by this share of the root's area and of the node's
// own.
constexpr float least_overlap = 1e-4f, least_own_overlap = 0.1f;
constexpr float least_gain = 0.99f;  // a spatial split costs no more than this, over the object split
// Sampling of references: every n-th reference decides whether a spatial split is worth testing for all. Boxes of a
// sample are not larger than those of all, so it is mostly optimistic. Every eighth would miss splits that pay off.
constexpr size_t many_references = 1 << 12, sample = 4;
constexpr size_t chunk = 1 << 14;         // references that one thread looks at at a time
constexpr size_t subtree_size = 1 << 12;  // references that one thread goes on with alone

// References [begin, end) of the array, with room up to `capacity`, and the node that they will become. Its descendants
// are stored from `slot` on: at most 2 (capacity - begin) - 2 of them.
struct Range {
    size_t begin, end, capacity;
    uint32_t node, slot;
    int depth;

    size_t size() const { return end - begin; }
    size_t room() const { return capacity - end; }
};
struct Halves {
    Range below, above;
};

class Builder {
public:
    Builder(SplitTree& tree, RawArray<Reference> references, size_t count, size_t capacity)
        : tree_(tree), references_(std::move(references)), root_{0, count, capacity, 0, 1, 0}
    {
    }

    void build()
    {
        least_overlap_ = least_overlap * spread(root_).box.half_area();
        std::vector<Range> open{root_}, small;
        for (std::vector<Range> next; !open.empty(); open.swap(next)) {
            next.clear();
            std::erase_if(open, [&](const Range& r) {
                if (r.size() > subtree_size) return false;
                small.push_back(r);
                return true;
            });
            std::vector<Halves> halves(open.size());
            parallel_for(open.size(), [&](size_t i) { halves[i] = divide(open[i]); });
            for (const Range& r : open) tree_.top.push_back(r.node);
            for (const Halves& h : halves) next.insert(next.end(), {h.below, h.above});
        }
        parallel_for(small.size(), [&](size_t i) { finish(small[i]); });
        for (const Range& r : small) tree_.subtrees.push_back(r.node);
    }

private:
    void finish(const Range& range)
    {
        std::vector<Range> open{range};
        while (!open.empty()) {
            const Range r = open.back();
            open.pop_back();
            if (r.size() == 1) {
                const Reference& only = references_[r.begin];
                tree_.nodes[r.node] = {to_box(only.box), 0, only.number()};
                continue;
            }
            const Halves h = divide(r);
            open.push_back(h.above);
            open.push_back(h.below);
        }
    }

    Halves divide(const Range& r)
    {
        const Spread s = spread(r);
        tree_.nodes[r.node] = {to_box(s.box), r.slot, 0};
        if (r.size() == 2 || r.depth >= max_free_depth) return halve(r);
        ObjectBins bins(s, r.size());
        gather(r, bins, [](auto& b, const Reference& x) { b.add(x); });
        const Division by_object = bins.best();
        if (!by_object) return halve(r);
        if (r.room() > 0 && overlap(by_object.below, by_object.above).half_area() >
                                std::max(least_overlap_, least_own_overlap * s.box.half_area()))
            if (const auto h = divide_space(r, s.box, by_object.cost * least_gain)) return *h;
        Reference* begin = references_.get() + r.begin;
        const Reference* middle =
            std::partition(begin, begin + r.size(), [&](const Reference& x) { return bins.is_below(by_object, x); });
        return part(r, static_cast<size_t>(middle - begin));
    }
    Halves halve(const Range& r) { return part(r, r.size() / 2); }

    // Splits off the first `count` references; the others move to make room.
    Halves part(const Range& r, size_t count)
    {
        const Halves h = halves(r, count, r.size() - count);
        const Reference* from = references_.get() + r.begin + count;
        std::copy_backward(from, from + h.above.size(), references_.get() + h.above.end);
        return h;
    }
    // The ranges of the children's references: the room is divided in proportion.
    static Halves halves(const Range& r, size_t below, size_t above)
    {
        const size_t room = r.capacity - r.begin - below - above;
        const size_t end = r.begin + below, middle = end + room * below / (below + above);
        const auto slot_above = static_cast<uint32_t>(r.slot + 2 * (middle - r.begin));
        return {{r.begin, end, middle, r.slot, r.slot + 2, r.depth + 1},
                {middle, middle + above, r.capacity, r.slot + 1, slot_above, r.depth + 1}};
    }

    // Divides by the best spatial split if it costs less than `cost`.
    std::optional<Halves> divide_space(const Range& r, const Box4& box, float cost)
    {
        if (r.size() >= many_references && !promises_less(r, box, cost)) return {};
        SpaceBins bins(box);
        gather(r, bins, [&](auto& to, const Reference& x) { to.add(tree_.triangles, x); });
        const Division best = bins.best(cost, r.size(), r.room());
        if (!best) return {};
        // Neither side gets more references than the bins have counted: fewer than before, and at least one.
        std::vector<Reference> above;
        above.reserve(best.count_above);
        size_t end = r.begin;
        for (size_t i = r.begin; i < r.end; ++i) {
            const Reference x = references_[i];
            if (bins.ends_below(best, x)) {
                references_[end++] = x;
            } else if (bins.starts_above(best, x)) {
                above.push_back(x);
            } else {
                const Clipped c = clip(tree_.triangles.corners(x.number()), x.box, best.axis, bins.plane(best));
                if (!c.above.empty()) above.emplace_back(c.above, x.number());
                if (!c.below.empty())
                    references_[end++] = Reference(c.below, x.number());
                else if (c.above.empty())
                    references_[end++] = x;
            }
        }
        const Halves h = halves(r, end - r.begin, above.size());
        std::copy(above.begin(), above.end(), references_.get() + h.above.begin);
        return h;
    }

    bool promises_less(const Range& r, const Box4& box, float cost) const
    {
        SpaceBins bins(box);
        size_t count = 0;
        for (size_t i = r.begin; i < r.end; i += sample, ++count) bins.add(tree_.triangles, references_[i]);
        const float share = static_cast<float>(count) / static_cast<float>(r.size());
        return static_cast<bool>(bins.best(cost * share, count, count));
    }

    Spread spread(const Range& r) const
    {
        Spread s;
        gather(r, s, [](Spread& to, const Reference& x) { to.add(x); });
        return s;
    }
    // Adds the references to `all`, which is empty, in parallel with a deterministic result.
    template <class T, class Add>
    void gather(const Range& r, T& all, const Add& add) const
    {
        const auto add_all = [&](T& to, size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) add(to, references_[i]);
        };
        if (r.size() <= chunk) return add_all(all, r.begin, r.end);
        std::vector<T> parts((r.size() + chunk - 1) / chunk, all);
        parallel_for(parts.size(), [&](size_t i) {
            const size_t begin = r.begin + i * chunk;
            add_all(parts[i], begin, std::min(begin + chunk, r.end));
        });
        for (const T& p : parts) all.add(p);
    }

    SplitTree& tree_;
    RawArray<Reference> references_;
    Range root_;
    float least_overlap_ = 0;
};

}  // namespace

SplitTree build_split_tree(const TriangleSet& triangles)
{
    const size_t n = triangles.size();
    const auto capacity = static_cast<size_t>(static_cast<double>(n) * (1 + duplicates)) + 1;
    if (capacity >= size_t{1} << 31) throw Error(ErrorKind::failed, {}, "too many_references triangles for one tree");
    SplitTree tree(triangles);
    RawArray<Reference> references(capacity);
    const size_t parts = (n + chunk - 1) / chunk;
    std::vector<size_t> finite(parts);
    parallel_for(parts, [&](size_t i) {
        for (size_t k = i * chunk, end = std::min(n, k + chunk); k < end; ++k) {
            const Corners c = triangles.corners(static_cast<uint32_t>(k));
            if (!is_finite(c[0]) || !is_finite(c[1]) || !is_finite(c[2])) continue;
            references[i * chunk + finite[i]++] =
                Reference(to_box4(box_of(c[0], c[1], c[2])), static_cast<uint32_t>(k));
        }
    });
    size_t count = 0;
    for (size_t i = 0; i < parts; count += finite[i++])
        std::copy_n(references.get() + i * chunk, finite[i], references.get() + count);
    if (count == 0) return tree;
    tree.slots = 2 * capacity;
    tree.nodes = RawArray<SplitNode>(tree.slots);
    Builder(tree, std::move(references), count, capacity).build();
    return tree;
}

}  // namespace lancer
