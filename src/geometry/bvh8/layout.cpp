#include "geometry/bvh8/layout.h"

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "core/parallel.h"

namespace lancer {
namespace {

constexpr uint64_t node_units = sizeof(Bvh8Node) / Bvh8Child::unit, leaf_units = sizeof(Bvh8Leaf) / Bvh8Child::unit;
constexpr size_t parts = 256;  // that threads take by turns; more than any number of threads has use for

static_assert(sizeof(Bvh8Node) % Bvh8Child::unit == 0 && sizeof(Bvh8Leaf) % Bvh8Child::unit == 0);
static_assert(Collapse::max_blocks <= Bvh8Child::max_blocks);

// Indices of a leaf's triangles: ascending, without duplicates, which spatial splits may cause.
struct Numbers {
    std::array<uint32_t, Collapse::width * Collapse::max_blocks> of;
    uint32_t count = 0;

    uint32_t blocks() const { return (count + Collapse::width - 1) / Collapse::width; }
};

// A wide node before it is written, with its children in the order of traversal for any hit.
struct Plan {
    struct Child {
        uint32_t node;
        bool is_leaf;
        Numbers numbers;  // of a leaf
    };
    std::array<Child, Collapse::width> children;
    size_t count = 0;
    uint64_t units = node_units;  // of it and its leaves

    auto begin() const { return children.begin(); }
    auto end() const { return children.begin() + count; }
};

// Sums over nodes.
struct Sums {
    double cost = 0;
    int depth = 0;
};

void make_empty(Bvh8Node& n)
{
    for (size_t k = 0; k < 6; ++k) n.planes[k].fill(k % 2 ? -FloatBox::inf : FloatBox::inf);
    n.children.fill(0);
}

class Layout {
public:
    explicit Layout(const SplitTree& tree) : tree_(tree), collapse_(tree) {}

    Bvh8Layout build()
    {
        // The top is written node by node, the subtrees below it in parallel.
        std::vector<Part> list{{.node = 0, .depth = 1}};
        size_t top = 0;
        for (; top < list.size() && list.size() - top < parts; ++top) {
            const Plan p = plan(list[top].node);
            list[top].units = p.units;
            list[top].first_child = list.size();
            for (const Plan::Child& c : p)
                if (!c.is_leaf) list.push_back({.node = c.node, .depth = list[top].depth + 1});
        }
        const auto each_other = [&](const auto& f) {
            parallel_for(list.size() - top, [&](size_t i) { f(list[top + i]); });
        };
        each_other([&](Part& p) { p.units = units_of_all(p.node); });
        uint64_t units = 0;
        for (Part& p : list) {
            p.offset = units;
            units += p.units;
        }
        if (units > Bvh8Child::max_offset) throw Error(ErrorKind::failed, {}, "too many triangles for one tree");
        out_.bytes = units * Bvh8Child::unit;
        out_.memory = RawArray<std::byte>(out_.bytes);
        out_.slot_of_leaf.resize(units / Bvh8Layout::grain + 1);
        for (size_t i = 0; i < top; ++i) {
            size_t next = list[i].first_child;
            write(plan(list[i].node), list[i], list[i].sums, [&](uint32_t, Bvh8Slot slot) {
                list[next].way = way_through(slot, list[i].way);
                return list[next++].offset;
            });
        }
        each_other([&](Part& p) { write_all(p, p.sums); });
        for (const Part& p : list) {
            out_.sah_cost += p.sums.cost / area(0);
            out_.depth = std::max(out_.depth, p.sums.depth);
        }
        return std::move(out_);
    }

private:
    // A node of the top, or the root of a subtree.
    struct Part {
        uint32_t node;
        int depth;
        size_t first_child = 0;  // in the list, of nodes of the top
        uint64_t units = 0, offset = 0;
        Bvh8Node::Way way{};
        Sums sums{};
    };

    double area(uint32_t node) const { return tree_.nodes[node].box.half_area(); }

    Plan plan(uint32_t node) const
    {
        Collapse::Children all = collapse_.children(node);
        const auto first = all.nodes.begin(), last = first + all.count;
        const auto merit = [&](uint32_t child) { return collapse_.merit(child); };
        const auto before = [&](uint32_t a, uint32_t b) { return std::pair(merit(b), a) < std::pair(merit(a), b); };
        // Insertion, as there are at most eight: std::sort of so few makes g++ 14 warn of bounds that are kept.
        for (auto i = first; i != last; ++i) std::rotate(std::upper_bound(first, i, *i, before), i, i + 1);
        Plan p;
        for (auto i = first; i != last; ++i) {
            Plan::Child& c = p.children[p.count++];
            c = {*i, collapse_.is_leaf(*i), {}};
            if (!c.is_leaf) continue;
            Numbers& n = c.numbers;
            add_numbers(*i, n);
            std::sort(n.of.begin(), n.of.begin() + n.count);
            n.count = static_cast<uint32_t>(std::unique(n.of.begin(), n.of.begin() + n.count) - n.of.begin());
            p.units += n.blocks() * leaf_units;
        }
        return p;
    }
    void add_numbers(uint32_t node, Numbers& to) const
    {
        const SplitNode& n = tree_.nodes[node];
        if (n.is_leaf()) {
            to.of[to.count++] = n.triangle;
            return;
        }
        add_numbers(n.child, to);
        add_numbers(n.child + 1, to);
    }

    uint64_t units_of_all(uint32_t node) const
    {
        const Plan p = plan(node);
        uint64_t units = p.units;
        for (const Plan::Child& c : p)
            if (!c.is_leaf) units += units_of_all(c.node);
        return units;
    }

    // Writes a node and its leaves; inner(child, slot) returns the offset of each other child, in order.
    template <class Inner>
    void write(const Plan& p, const Part& part, Sums& sums, const Inner& inner)
    {
        auto& n = *new (at(part.offset)) Bvh8Node;
        make_empty(n);
        n.way = part.way;
        sums.cost += area(part.node);
        sums.depth = std::max(sums.depth, part.depth);
        uint64_t next = part.offset + node_units;
        for (size_t k = 0; k < p.count; ++k) {
            const Plan::Child& c = p.children[k];
            const FloatBox& box = tree_.nodes[c.node].box;
            for (size_t axis = 0; axis < 3; ++axis) {
                n.planes[2 * axis][k] = box.lower[static_cast<int>(axis)];
                n.planes[2 * axis + 1][k] = box.upper[static_cast<int>(axis)];
            }
            const Bvh8Slot slot(part.offset, k);
            if (!c.is_leaf) {
                n.children[k] = Bvh8Child::node(inner(c.node, slot)).bits();
                continue;
            }
            n.children[k] = Bvh8Child::leaf(next, c.numbers.blocks()).bits();
            out_.slot_of_leaf[next / Bvh8Layout::grain] = slot;
            for (uint32_t i = 0; i < c.numbers.blocks(); ++i, next += leaf_units) write_leaf(c.numbers, i, next);
            sums.cost += area(c.node) * c.numbers.count;
        }
    }
    // Writes a subtree and returns its end.
    uint64_t write_all(const Part& part, Sums& sums)
    {
        const Plan p = plan(part.node);
        uint64_t end = part.offset + p.units;
        write(p, part, sums, [&](uint32_t child, Bvh8Slot slot) {
            const uint64_t offset = end;
            end = write_all(
                {.node = child, .depth = part.depth + 1, .offset = offset, .way = way_through(slot, part.way)}, sums);
            return offset;
        });
        return end;
    }
    void write_leaf(const Numbers& numbers, uint32_t block, uint64_t offset)
    {
        auto& leaf = *new (at(offset)) Bvh8Leaf;
        constexpr Vec3 nowhere{NAN, NAN, NAN};
        for (size_t lane = 0; lane < Collapse::width; ++lane) {
            const size_t i = block * Collapse::width + lane;
            const bool is_there = i < numbers.count;
            leaf.numbers[lane] = is_there ? numbers.of[i] : UINT32_MAX;
            const Corners triangle =
                is_there ? tree_.triangles.corners(numbers.of[i]) : Corners{nowhere, nowhere, nowhere};
            for (size_t corner = 0; corner < 3; ++corner)
                for (size_t axis = 0; axis < 3; ++axis)
                    leaf.corners[corner][axis][lane] = triangle[corner][static_cast<int>(axis)];
        }
    }
    static Bvh8Node::Way way_through(Bvh8Slot slot, const Bvh8Node::Way& way)
    {
        Bvh8Node::Way longer{slot};
        std::copy(way.begin(), way.end() - 1, longer.begin() + 1);
        return longer;
    }
    std::byte* at(uint64_t offset) { return out_.memory.get() + offset * Bvh8Child::unit; }

    const SplitTree& tree_;
    Collapse collapse_;
    Bvh8Layout out_;
};

}  // namespace

Bvh8Layout lay_out(const SplitTree& tree)
{
    if (!tree.empty()) return Layout(tree).build();
    Bvh8Layout out;
    out.memory = RawArray<std::byte>(out.bytes = sizeof(Bvh8Node));
    make_empty(*new (out.memory.get()) Bvh8Node);
    return out;
}

}  // namespace lancer
