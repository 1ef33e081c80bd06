#include "geometry/bvh2/builder.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <utility>

#include "core/parallel.h"

namespace lancer {
namespace {

using Child = BinaryTree::Child;
using Pair = BinaryTree::Pair;

constexpr uint32_t chunk_size = 1 << 13;  // primitives that one step of a parallel loop handles

// A range of primitives with its bounds.
struct PartBounds {
    BoxLanes box, centers;

    void grow(const BoxedPrimitive& p)
    {
        box.grow(p.box);
        centers.grow(p.center());
    }
    void grow(const PartBounds& b)
    {
        box.grow(b.box);
        centers.grow(b.centers);
    }
};
struct Range {
    uint32_t begin, end, depth;
    PartBounds bounds;

    uint32_t size() const { return end - begin; }
};

// A plane perpendicular to an axis. The side of a primitive is computed by the same arithmetic that counted it.
struct Cut {
    int axis;
    Float4 origin, scale;
    float place;

    static Float4 along(Float4 center, Float4 origin, Float4 scale) { return (center - origin) * scale; }
    bool is_left(const BoxedPrimitive& p) const { return along(p.center(), origin, scale)[axis] < place; }
};

// Runs f(begin, end, part) over chunks of the range in parallel and joins the parts. The order does not matter: parts
// consist of minima, maxima and counts.
template <class Part, class F>
Part over_chunks(const Range& r, const F& f)
{
    std::vector<Part> parts((r.size() + chunk_size - 1) / chunk_size);
    parallel_for(parts.size(), [&](size_t k) {
        const uint32_t begin = r.begin + static_cast<uint32_t>(k) * chunk_size;
        f(begin, std::min(r.end, begin + chunk_size), parts[k]);
    });
    for (size_t k = 1; k < parts.size(); ++k) parts[0].grow(parts[k]);
    return parts[0];
}

class MedianCuts {
public:
    static std::optional<Cut> choose(const BoxedPrimitive*, const Range& r, bool)
    {
        const Float4 d = r.bounds.box.upper - r.bounds.box.lower;
        const int axis = d[0] >= d[1] ? (d[0] >= d[2] ? 0 : 2) : (d[1] >= d[2] ? 1 : 2);
        return Cut{axis, BoxedPrimitive{r.bounds.box.box(), 0}.center(), broadcast_to<Float4>(1), 0};
    }
};

class SahCuts {
public:
    static std::optional<Cut> choose(const BoxedPrimitive* all, const Range& r, bool parallel)
    {
        const uint32_t used = std::min(bins, 4 + r.size() / 2);  // few suffice for few
        const Float4 extent = r.bounds.centers.upper - r.bounds.centers.lower;
        // Slightly less than `used`, so that rounding never gives a bin behind the last one.
        const Float4 scale = select(extent > 0.0f, static_cast<float>(used) * (1 - gamma(4)) / extent, Float4{});
        const Binning binning{r.bounds.centers.lower, scale, Int4{} + static_cast<int>(used - 1)};
        const auto fill = [&](uint32_t begin, uint32_t end, Bins& b) { binning.fill(all + begin, all + end, b); };
        if (parallel) return best(over_chunks<Bins>(r, fill), used, binning);
        Bins b;
        fill(r.begin, r.end, b);
        return best(b, used, binning);
    }

private:
    static constexpr uint32_t bins = 32;

    struct Bins {
        BoxLanes box[3][bins];
        uint32_t count[3][bins] = {};

        void grow(const Bins& b)
        {
            for (int axis = 0; axis < 3; ++axis)
                for (uint32_t k = 0; k < bins; ++k) {
                    box[axis][k].grow(b.box[axis][k]);
                    count[axis][k] += b.count[axis][k];
                }
        }
    };
    struct Binning {
        Float4 origin, scale;
        Int4 last;

        void fill(const BoxedPrimitive* p, const BoxedPrimitive* end, Bins& b) const
        {
            for (; p != end; ++p) {
                const Int4 bin = min(max(truncate(Cut::along(p->center(), origin, scale)), Int4{}), last);
                add(b, 0, bin[0], *p);
                add(b, 1, bin[1], *p);
                add(b, 2, bin[2], *p);
            }
        }
        static void add(Bins& b, int axis, int bin, const BoxedPrimitive& p)
        {
            b.box[axis][bin].grow(p.box);
            ++b.count[axis][bin];
        }
    };

    static std::optional<Cut> best(const Bins& b, uint32_t used, const Binning& binning)
    {
        std::optional<Cut> cut;
        float least = FloatBox::inf;
        for (int axis = 0; axis < 3; ++axis) {
            float right_cost[bins];  // of the bins from k on; 0 where they are empty
            BoxLanes box;
            uint32_t count = 0;
            for (uint32_t k = used - 1; k > 0; --k) {
                box.grow(b.box[axis][k]);
                count += b.count[axis][k];
                right_cost[k] = cost(box, count);
            }
            box = {};
            count = 0;
            for (uint32_t k = 1; k < used; ++k) {
                box.grow(b.box[axis][k - 1]);
                count += b.count[axis][k - 1];
                if (count == 0 || right_cost[k] == 0) continue;
                const float both = cost(box, count) + right_cost[k];
                if (both < least) {
                    least = both;
                    cut = Cut{axis, binning.origin, binning.scale, static_cast<float>(k)};
                }
            }
        }
        return cut;
    }
    // NaN and infinity, from huge boxes, are never minimal.
    static float cost(const BoxLanes& box, uint32_t count)
    {
        return count == 0 ? 0 : box.half_area() * static_cast<float>(count);
    }
};

template <class Cuts>
class Builder {
public:
    Builder(std::vector<BoxedPrimitive> primitives, uint32_t leaf_size)
        : items_(std::move(primitives)), leaf_size_(leaf_size)
    {
    }

    BuiltTree build()
    {
        BuiltTree built;
        const auto count = static_cast<uint32_t>(items_.size());
        if (count == 0) return built;
        Range whole{0, count, 0, {}};
        whole.bounds = over_chunks<PartBounds>(whole, [&](uint32_t begin, uint32_t end, PartBounds& b) {
            for (uint32_t i = begin; i < end; ++i) b.grow(items_[i]);
        });
        // Large nodes are split one after the other with all threads; smaller ones become tasks of one thread each.
        task_size_ = std::max<uint32_t>(1 << 12, count / 64);
        if (count > task_size_) scratch_.resize(count);
        std::vector<Pair> pairs;
        Child root = cut_large(whole, pairs);
        std::vector<std::vector<Pair>> subtrees(tasks_.size());
        std::vector<Child> roots(tasks_.size());
        parallel_for(tasks_.size(), [&](size_t k) {
            subtrees[k].reserve(tasks_[k].size() / 2);
            roots[k] = cut_small(tasks_[k], subtrees[k]);
        });
        join(subtrees, roots, pairs, root);
        built.order.resize(count);
        for (uint32_t i = 0; i < count; ++i) built.order[i] = items_[i].number();
        built.tree = BinaryTree(whole.bounds.box.box(), root, std::move(pairs));
        return built;
    }

private:
    // Placeholder of task k until join() inserts its root.
    static constexpr uint32_t is_task = UINT32_MAX;

    Child cut_large(const Range& r, std::vector<Pair>& pairs)
    {
        if (r.size() <= task_size_) {
            tasks_.push_back(r);
            return {static_cast<uint32_t>(tasks_.size() - 1), is_task};
        }
        return inner(r, pairs, true, [&](const Range& part) { return cut_large(part, pairs); });
    }
    Child cut_small(const Range& r, std::vector<Pair>& pairs)
    {
        if (r.size() <= leaf_size_) return {r.begin, r.size()};
        return inner(r, pairs, false, [&](const Range& part) { return cut_small(part, pairs); });
    }
    template <class Below>
    Child inner(const Range& r, std::vector<Pair>& pairs, bool parallel, const Below& below)
    {
        auto [left, right] = cut(r, parallel);
        if (left.bounds.box.half_area() < right.bounds.box.half_area()) std::swap(left, right);
        const auto number = static_cast<uint32_t>(pairs.size());
        pairs.emplace_back();
        const Child first = below(left), second = below(right);
        pairs[number].set(0, left.bounds.box.box(), first);
        pairs[number].set(1, right.bounds.box.box(), second);
        return {number, 0};
    }

    // depth + log2(size), rounded up, never exceeds max_depth: halving keeps the sum, and another split is only done if
    // it may grow by one.
    std::pair<Range, Range> cut(const Range& r, bool parallel)
    {
        const auto levels = static_cast<uint32_t>(std::bit_width(r.size() - 1));
        if (r.depth + levels < BinaryTree::max_depth)
            if (const auto cut = Cuts::choose(items_.data(), r, parallel)) {
                Range left{r.begin, r.begin, r.depth + 1, {}}, right{r.end, r.end, r.depth + 1, {}};
                parallel ? partition_large(*cut, r, left, right) : partition(*cut, left, right);
                if (left.size() != 0 && right.size() != 0) return {left, right};
            }
        const uint32_t middle = r.begin + (r.size() + 1) / 2;
        return {part_of(r, r.begin, middle), part_of(r, middle, r.end)};
    }
    Range part_of(const Range& r, uint32_t begin, uint32_t end) const
    {
        Range part{begin, end, r.depth + 1, {}};
        for (uint32_t i = begin; i < end; ++i) part.bounds.grow(items_[i]);
        return part;
    }
    void partition(const Cut& cut, Range& left, Range& right)
    {
        while (left.end < right.begin) {
            BoxedPrimitive& p = items_[left.end];
            if (cut.is_left(p)) {
                left.bounds.grow(p);
                ++left.end;
            } else {
                right.bounds.grow(p);
                std::swap(p, items_[--right.begin]);
            }
        }
    }
    // In chunks: counts the left side, then moves all primitives to scratch memory, in order, and back.
    void partition_large(const Cut& cut, const Range& r, Range& left, Range& right)
    {
        struct Part {
            uint32_t left = 0;
            PartBounds bounds[2];
        };
        std::vector<Part> parts((r.size() + chunk_size - 1) / chunk_size);
        const auto each_chunk = [&](const auto& f) {
            parallel_for(parts.size(), [&](size_t k) {
                const uint32_t begin = r.begin + static_cast<uint32_t>(k) * chunk_size;
                f(parts[k], begin, std::min(r.end, begin + chunk_size));
            });
        };
        each_chunk([&](Part& part, uint32_t begin, uint32_t end) {
            for (uint32_t i = begin; i < end; ++i) {
                const bool is_left = cut.is_left(items_[i]);
                part.bounds[is_left ? 0 : 1].grow(items_[i]);
                part.left += is_left ? 1 : 0;
            }
        });
        for (Part& part : parts) {
            left.bounds.grow(part.bounds[0]);
            right.bounds.grow(part.bounds[1]);
            left.end += std::exchange(part.left, left.end);  // from here on where the chunk's left ones go
        }
        right.begin = left.end;
        each_chunk([&](const Part& part, uint32_t begin, uint32_t end) {
            uint32_t to_left = part.left, to_right = right.begin + (begin - r.begin) - (part.left - r.begin);
            for (uint32_t i = begin; i < end; ++i)
                scratch_[cut.is_left(items_[i]) ? to_left++ : to_right++] = items_[i];
        });
        each_chunk([&](const Part&, uint32_t begin, uint32_t end) {
            std::copy(scratch_.begin() + begin, scratch_.begin() + end, items_.begin() + begin);
        });
    }

    // Appends the subtrees and links them from the nodes above.
    static void join(const std::vector<std::vector<Pair>>& subtrees, const std::vector<Child>& roots,
                     std::vector<Pair>& pairs, Child& root)
    {
        std::vector<uint32_t> first(subtrees.size());
        const auto above = static_cast<uint32_t>(pairs.size());
        uint32_t size = above;
        for (size_t k = 0; k < subtrees.size(); ++k) {
            first[k] = size;
            size += static_cast<uint32_t>(subtrees[k].size());
        }
        pairs.resize(size);
        const auto shifted = [](Child c, uint32_t by) { return c.count == 0 ? Child{c.first + by, 0} : c; };
        const auto enter = [&](Child& c) {
            if (c.count == is_task) c = shifted(roots[c.first], first[c.first]);
        };
        enter(root);
        for (uint32_t i = 0; i < above; ++i)
            for (Child& c : pairs[i].child) enter(c);
        parallel_for(subtrees.size(), [&](size_t k) {
            for (size_t i = 0; i < subtrees[k].size(); ++i) {
                Pair p = subtrees[k][i];
                for (Child& c : p.child) c = shifted(c, first[k]);
                pairs[first[k] + i] = p;
            }
        });
    }

    std::vector<BoxedPrimitive> items_, scratch_;
    std::vector<Range> tasks_;
    uint32_t leaf_size_, task_size_ = 0;
};

}  // namespace

BuiltTree build_median(std::vector<BoxedPrimitive> primitives, uint32_t leaf_size)
{
    return Builder<MedianCuts>(std::move(primitives), leaf_size).build();
}

BuiltTree build_sah(std::vector<BoxedPrimitive> primitives, uint32_t leaf_size)
{
    return Builder<SahCuts>(std::move(primitives), leaf_size).build();
}

}  // namespace lancer
