#include "geometry/bvh8/collapse.h"

#include <algorithm>
#include <unordered_map>

#include "core/parallel.h"

namespace lancer {
namespace {

// Costs of a node and of a block of triangles for a ray that hits it. Speeds measured with block costs of 0.5 to 1
// differ by no more than noise.
constexpr float node_cost = 1, block_cost = 0.7f;
// Three levels of the binary tree become one node.
constexpr float level_cost = node_cost / 3;
constexpr uint32_t many = 255, all_places = (1u << 21) - 1;

uint32_t blocks(uint32_t triangles) { return (triangles + Collapse::width - 1) / Collapse::width; }
uint32_t places_of_first(uint32_t below, int places) { return below >> 3 * (places - 2) & 7; }

}  // namespace

Collapse::Collapse(const SplitTree& tree) : tree_(tree), decisions_(tree.slots), merits_(tree.slots)
{
    std::vector<Choice> roots(tree.subtrees.size());
    parallel_for(roots.size(), [&](size_t i) { roots[i] = choose_below(tree.subtrees[i]); });
    std::unordered_map<uint32_t, Choice> chosen;
    for (size_t i = 0; i < roots.size(); ++i) chosen.emplace(tree.subtrees[i], roots[i]);
    for (size_t i = tree.top.size(); i-- > 0;) {
        const uint32_t node = tree.top[i], child = tree.nodes[node].child;
        chosen.emplace(node, choose(node, chosen.at(child), chosen.at(child + 1)));
    }
}

Collapse::Choice Collapse::choose_below(uint32_t node)
{
    const SplitNode& n = tree_.nodes[node];
    if (n.is_leaf()) return choose_leaf(node);
    const Choice first = choose_below(n.child);
    return choose(node, first, choose_below(n.child + 1));
}

Collapse::Choice Collapse::choose_leaf(uint32_t node)
{
    const SplitNode& n = tree_.nodes[node];
    Choice c;
    c.area = n.box.half_area();
    c.cost.fill(c.area * block_cost);
    c.triangles = 1;
    c.any_hit = any_hit_of(tree_.triangles.corners(n.triangle), c.area, block_cost);
    decisions_[node] = {.leaf = 1, .below = 0};
    merits_[node] = c.any_hit.merit();
    return c;
}

Collapse::Choice Collapse::choose(uint32_t node, const Choice& a, const Choice& b)
{
    Choice c;
    c.area = tree_.nodes[node].box.half_area();
    // Cost of both children with `places` slots, and the best number of slots of the first one.
    std::array<float, width + 1> divided{};
    std::array<uint32_t, width + 1> first{};
    for (size_t places = 2; places <= width; ++places) {
        divided[places] = FloatBox::inf;
        first[places] = 1;
        for (size_t k = 1; k < places; ++k) {
            const float cost = a.cost[k - 1] + b.cost[places - k - 1];
            if (!(cost < divided[places])) continue;
            divided[places] = cost;
            first[places] = static_cast<uint32_t>(k);
        }
    }
    uint32_t below = 0;
    const auto set_first = [&](size_t places) { below |= first[places] << 3 * (places - 2); };

    c.triangles = std::min(many, a.triangles + b.triangles);
    const float as_node = divided[width] + c.area * node_cost;
    const float leaf_cost = block_cost * static_cast<float>(blocks(c.triangles)), as_leaf = c.area * leaf_cost;
    const bool is_leaf = c.triangles <= width * max_blocks && !(as_node < as_leaf);
    c.cost[0] = is_leaf ? as_leaf : as_node;
    const float per_area = 1 / c.area;
    const auto share = [&](const Choice& child) { return std::min(1.0f, child.area * per_area); };
    c.any_hit = any_hit_of(a.any_hit, share(a), b.any_hit, share(b), level_cost);
    if (is_leaf) c.any_hit.work = leaf_cost;
    set_first(width);
    for (size_t places = 2; places < width; ++places) {
        c.cost[places - 1] = std::min(divided[places], c.cost[places - 2]);
        if (divided[places] < c.cost[places - 2]) set_first(places);
    }
    decisions_[node] = {.leaf = is_leaf, .below = below & all_places};
    merits_[node] = c.any_hit.merit();
    return c;
}

Collapse::Children Collapse::children(uint32_t node) const
{
    Children to;
    if (is_leaf(node)) {
        to.nodes[to.count++] = node;
        return to;
    }
    const uint32_t child = tree_.nodes[node].child, first = places_of_first(decisions_[node].below, width);
    add_children(child, static_cast<int>(first), to);
    add_children(child + 1, width - static_cast<int>(first), to);
    return to;
}

void Collapse::add_children(uint32_t node, int places, Children& to) const
{
    uint32_t first = 0;
    while (places > 1 && first == 0) {
        first = places_of_first(decisions_[node].below, places);
        if (first == 0) --places;
    }
    if (places == 1) {
        to.nodes[to.count++] = node;
        return;
    }
    const uint32_t child = tree_.nodes[node].child;
    add_children(child, static_cast<int>(first), to);
    add_children(child + 1, places - static_cast<int>(first), to);
}

}  // namespace lancer
