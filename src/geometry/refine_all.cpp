#include "geometry/refine_all.h"

#include "core/lanes/prefetch.h"
#include "geometry/ray_lanes.h"
#include "geometry/triangle_lanes.h"

namespace lancer {
namespace {

Double4 clamp(Double4 x, Double4 least, Double4 most) { return select(x < least, least, select(most < x, most, x)); }

// hits[which[k]]: hits of non-instanced triangles.
void refine_four(const Geometry& g, std::span<const Ray> rays, std::span<Hit> hits, const FourHits& which)
{
    std::array<Float4, double_lanes> v0, v1, v2, org, dir;
    for (size_t k = 0; k < double_lanes; ++k) {
        const Ray& ray = rays[which[k]];
        const Mesh& m = g.meshes[hits[which[k]].geometry];
        const auto& corners = m.triangles[hits[which[k]].primitive];
        const AxisOrder& in_order = axis_order(ray.dir);
        const auto corner = [&](size_t c) { return in_order(load4(&m.positions[corners[c]].x)); };
        v0[k] = corner(0), v1[k] = corner(1), v2[k] = corner(2);
        org[k] = in_order(org_and_t_min(ray)), dir[k] = in_order(dir_and_t_max(ray));
    }
    const auto in_double = [](const std::array<Float4, double_lanes>& v) { return to_double(turned(v)); };
    const PlaneHit<Double4> h(in_double(v0), in_double(v1), in_double(v2), in_double(org), in_double(dir));
    const Double4 u = clamp(h.u, Double4{}, broadcast(1.0)), v = clamp(h.v, Double4{}, 1.0 - u);
    const Float4 t4 = to_float(h.t), u4 = to_float(u), v4 = to_float(v);
    for (size_t k = 0; k < double_lanes; ++k) {
        Hit& hit = hits[which[k]];
        const bool from_its_edge = h.det[k] == 0;
        hit.t = std::max(0.0f, from_its_edge ? hit.t : static_cast<float>(t4[k]));
        hit.uv = from_its_edge ? Vec2{} : Vec2{u4[k], v4[k]};
    }
}

// In large meshes each is a cache miss; prefetching overlaps them.
void fetch_corners(const Geometry& g, std::span<const Hit> hits)
{
    for (const Hit& hit : hits)
        if (hit.kind == Kind::triangle) prefetch(&g.meshes[hit.geometry].triangles[hit.primitive]);
    for (const Hit& hit : hits) {
        if (hit.kind != Kind::triangle) continue;
        const Mesh& m = g.meshes[hit.geometry];
        for (const uint32_t corner : m.triangles[hit.primitive]) prefetch(&m.positions[corner]);
    }
}

}  // namespace

void refine_all(const Geometry& g, std::span<const Ray> rays, std::span<Hit> hits)
{
    if (exceeds_caches(g)) fetch_corners(g, hits);
    for_triangles<double_lanes>(
        hits, [&](const FourHits& which) { refine_four(g, rays, hits, which); },
        [&](size_t i) { hits[i] = refine(g, rays[i], hits[i]); });
}

}  // namespace lancer
