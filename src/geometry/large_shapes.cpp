#include "geometry/large_shapes.h"

#include <numeric>

namespace lancer {
namespace {

constexpr uint32_t most = 16;  // of each kind

std::vector<uint32_t> numbers(size_t count)
{
    std::vector<uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0u);
    return all;
}

// In ascending order of size: the first sphere that is wider than the box of all smaller ones, and all larger ones.
std::vector<uint32_t> giants(const std::vector<Sphere>& spheres)
{
    std::vector<uint32_t> order = numbers(spheres.size());
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return spheres[a].radius < spheres[b].radius; });
    Bounds smaller;
    size_t first = 0;
    while (first < order.size() && (smaller.empty() || spheres[order[first]].radius < smaller.extent()))
        smaller.grow(bounds(spheres[order[first++]]));
    order.erase(order.begin(), order.begin() + static_cast<ptrdiff_t>(std::max(
                                                   first, order.size() - std::min<size_t>(most, order.size()))));
    std::sort(order.begin(), order.end());
    return order;
}

}  // namespace

LargeShapes choose_large_shapes(const Geometry& g)
{
    const auto asks = [&](bool any) { return g.alpha_test.passes_through && any; };
    const size_t few = g.meshes.empty() ? most : most / 2;
    LargeShapes wide;
    if (!asks(g.alpha_test.spheres))
        wide.spheres = g.spheres.size() <= few ? numbers(g.spheres.size()) : giants(g.spheres);
    if (!asks(g.alpha_test.planes) && g.planes.size() <= most) wide.planes = numbers(g.planes.size());
    return wide;
}

}  // namespace lancer
