#include "support/closed_mesh.h"

namespace lancer {

bool is_closed(const Mesh& mesh)
{
    std::map<std::array<float, 3>, uint32_t> numbers;
    const auto number = [&](uint32_t v) {
        const Vec3 p = mesh.positions[v];
        return numbers.try_emplace({p.x, p.y, p.z}, static_cast<uint32_t>(numbers.size())).first->second;
    };
    std::vector<std::pair<uint32_t, uint32_t>> edges;
    for (const auto& t : mesh.triangles) {
        const std::array<uint32_t, 3> v{number(t[0]), number(t[1]), number(t[2])};
        for (size_t k = 0; k < 3; ++k)
            if (v[k] != v[(k + 1) % 3]) edges.push_back(std::minmax(v[k], v[(k + 1) % 3]));
    }
    std::sort(edges.begin(), edges.end());
    for (size_t i = 0; i < edges.size();) {
        size_t end = i;
        while (end < edges.size() && edges[end] == edges[i]) ++end;
        if ((end - i) % 2) return false;
        i = end;
    }
    return !edges.empty();
}

Mesh moved(const Mesh& mesh, Vec3d by)
{
    Mesh m = mesh;
    for (size_t i = 0; i + 1 < m.positions.size(); ++i) m.positions[i] = to_float(to_double(m.positions[i]) + by);
    return m;
}

double distance_to_segment(Vec3d p, Vec3d a, Vec3d b)
{
    const Vec3d d = b - a;
    const double d2 = dot(d, d), s = d2 > 0 ? std::clamp(dot(p - a, d) / d2, 0.0, 1.0) : 0;
    return length(p - (a + d * s));
}

double distance_to_triangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c)
{
    const Vec3d n = cross(b - a, c - a);
    const auto beside = [&](Vec3d from, Vec3d to) { return dot(cross(to - from, p - from), n) < 0; };
    if (length(n) > 0 && !beside(a, b) && !beside(b, c) && !beside(c, a)) return std::abs(dot(p - a, n)) / length(n);
    return std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

std::vector<Ball> balls_inside(const Geometry& g, uint32_t count, uint64_t seed)
{
    const Mesh& mesh = g.meshes.at(0);
    const DoubleTree tree(g);
    const auto corner = [&](uint32_t v) { return to_double(mesh.positions[v]); };
    Bounds all;
    for (const auto& t : mesh.triangles)
        for (const uint32_t v : t) all.grow(corner(v));
    const double coordinate = std::max(max_component(abs(all.lower)), max_component(abs(all.upper)));
    const double least = coordinate * 0x1p-19;
    std::vector<Ball> balls;
    for (uint64_t i = 0; i < 500 && balls.size() < count; ++i) {
        AddressedRandom random(seed, i);
        // The first in the middle, which is the origin where a mesh lies around it.
        const Vec3d at = to_double(to_float(i == 0 ? all.center() : random.in_box(all.lower, all.upper)));
        double clear = INFINITY;
        for (const auto& t : mesh.triangles) {
            clear = std::min(clear, distance_to_triangle(at, corner(t[0]), corner(t[1]), corner(t[2])));
            if (clear < least) break;
        }
        if (clear < least) continue;
        uint32_t odd = 0;
        for (int k = 0; k < 5; ++k)
            odd += tree.crossings({.org = to_float(at), .dir = to_float(random.direction())}) % 2 ? 1 : 0;
        if (odd == 5) balls.push_back({at, clear / 2});
    }
    return balls;
}

}  // namespace lancer
