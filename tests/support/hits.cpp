#include "support/hits.h"

namespace lancer {

bool same_bits(const Hit& a, const Hit& b)
{
    return same_primitive(a, b) && std::bit_cast<uint32_t>(a.t) == std::bit_cast<uint32_t>(b.t) &&
           std::bit_cast<uint32_t>(a.uv.x) == std::bit_cast<uint32_t>(b.uv.x) &&
           std::bit_cast<uint32_t>(a.uv.y) == std::bit_cast<uint32_t>(b.uv.y);
}

double ulps_from_edge(const Geometry& g, const Ray& ray, const Hit& hit)
{
    Vec3d org = to_double(ray.org), dir = to_double(ray.dir);
    if (hit.instance != Hit::no_instance) {
        const Transform& m = g.instances[hit.instance].to_mesh;
        org = m.point(org), dir = m.vector(dir);
    }
    const Mesh& mesh = g.meshes[hit.geometry];
    double least = INFINITY, size = length(org);
    for (size_t k = 0; k < 3; ++k) {
        const auto& t = mesh.triangles[hit.primitive];
        const Vec3d a = to_double(mesh.positions[t[k]]), b = to_double(mesh.positions[t[(k + 1) % 3]]);
        const Vec3d across = cross(b - a, dir);
        least = std::min(least, std::abs(dot(across, a - org)) / length(across));
        size = std::max(size, length(a));
    }
    return least / (size * 0x1p-24);
}

double doubt(const Geometry& g, const Ray& ray, const Hit& hit)
{
    Vec3d org = to_double(ray.org), dir = to_double(ray.dir);
    double cosine = 1;
    if (hit.kind == Kind::triangle) {
        if (hit.instance != Hit::no_instance) {
            const Transform& m = g.instances[hit.instance].to_mesh;
            org = m.point(org), dir = m.vector(dir);
        }
        const Mesh& mesh = g.meshes[hit.geometry];
        const auto& t = mesh.triangles[hit.primitive];
        const Vec3d a = to_double(mesh.positions[t[0]]), b = to_double(mesh.positions[t[1]]),
                    c = to_double(mesh.positions[t[2]]);
        cosine = std::abs(dot(normalize(cross(b - a, c - a)), dir));
    }
    return 16 * 0x1p-24 * std::max(length(org), static_cast<double>(hit.t) * length(dir)) / cosine;
}

bool explainable(const Geometry& g, const Ray& ray, const Hit& a, const Hit& b)
{
    if (a && b && static_cast<double>(std::abs(a.t - b.t)) <= std::max(doubt(g, ray, a), doubt(g, ray, b))) return true;
    const Hit& nearer = !b || (a && a.t < b.t) ? a : b;
    return nearer.kind == Kind::triangle && ulps_from_edge(g, ray, nearer) < 32;
}

}  // namespace lancer
