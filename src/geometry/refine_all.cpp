#include "geometry/refine_all.h"

#include <array>

#include "geometry/ray_lanes.h"

namespace lancer {
namespace {

// One vector of each lane, as it is in float.
Vec3T<Double4> to_double(std::array<Float4, double_lanes> v)
{
    _MM_TRANSPOSE4_PS(v[0], v[1], v[2], v[3]);
    return {_mm256_cvtps_pd(v[0]), _mm256_cvtps_pd(v[1]), _mm256_cvtps_pd(v[2])};
}

Double4 clamp(Double4 x, Double4 least, Double4 most) { return select(x < least, least, select(most < x, most, x)); }

// hits[which[k]]: triangles drawn as they are.
void refine_four(const Geometry& g, std::span<const Ray> rays, std::span<Hit> hits,
                 const std::array<size_t, double_lanes>& which)
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
    const PlaneHit<Double4> h(to_double(v0), to_double(v1), to_double(v2), to_double(org), to_double(dir));
    const Double4 u = clamp(h.u, Double4{}, all_lanes(1.0)), v = clamp(h.v, Double4{}, 1.0 - u);
    const Float4 t4 = _mm256_cvtpd_ps(h.t), u4 = _mm256_cvtpd_ps(u), v4 = _mm256_cvtpd_ps(v);
    for (size_t k = 0; k < double_lanes; ++k) {
        Hit& hit = hits[which[k]];
        const bool from_its_edge = h.det[k] == 0;
        hit.t = std::max(0.0f, from_its_edge ? hit.t : static_cast<float>(t4[k]));
        hit.uv = from_its_edge ? Vec2{} : Vec2{u4[k], v4[k]};
    }
}

}  // namespace

void refine_all(const Geometry& g, std::span<const Ray> rays, std::span<Hit> hits)
{
    std::array<size_t, double_lanes> waiting{};
    size_t count = 0;
    for (size_t i = 0; i < hits.size(); ++i) {
        const Hit& hit = hits[i];
        if (hit.kind == Kind::triangle && hit.instance == Hit::no_instance) {
            waiting[count++] = i;
            if (count == double_lanes) refine_four(g, rays, hits, waiting), count = 0;
        } else if (hit) {
            hits[i] = refine(g, rays[i], hit);
        }
    }
    if (count == 0) return;
    std::fill(waiting.begin() + count, waiting.end(), waiting[0]);
    refine_four(g, rays, hits, waiting);
}

}  // namespace lancer
