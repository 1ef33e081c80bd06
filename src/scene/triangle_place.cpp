#include "scene/triangle_place.h"

#include "core/prefetch.h"
#include "geometry/triangle_lanes.h"
#include "scene/scene.h"

namespace lancer {
namespace {

// |M| v: how far an error per axis can reach through a linear map.
Vec3d spread(const Transform& m, Vec3d v) { return abs(m.x) * v.x + abs(m.y) * v.y + abs(m.z) * v.z; }

using Rows = std::array<Float4, double_lanes>;  // what stands in memory of four places

// Normals of a triangle's corners, each with something behind it; those of CornerNormals::of_flat() where it has none.
void put_normals(const Mesh& mesh, const CornerNormals& normals, uint32_t triangle, size_t k, Rows& a, Rows& b, Rows& c)
{
    a[k] = b[k] = c[k] = Float4{} + CornerNormals::of_flat().x;
    if (normals.empty()) return;
    const auto& corners = normals.named_by(mesh, triangle);
    if (corners[0] == CornerNormals::none) return;
    const auto normal = [&](size_t i) { return load4(&normals.values[corners[i]].x); };
    a[k] = normal(0), b[k] = normal(1), c[k] = normal(2);
}

template <bool has_normals>
PlacesOfFour places(const Scene& scene, std::span<const Hit> hits, const FourHits& which)
{
    Rows rows_uv, rows_a, rows_b, rows_c, normals_a, normals_b, normals_c;
    for (size_t k = 0; k < double_lanes; ++k) {
        const Hit& hit = hits[which[k]];
        const Mesh& mesh = scene.geometry.meshes[hit.geometry];
        const auto& t = mesh.triangles[hit.primitive];
        rows_uv[k] = load4(&hit.uv.x);
        rows_a[k] = load4(&mesh.positions[t[0]].x);
        rows_b[k] = load4(&mesh.positions[t[1]].x);
        rows_c[k] = load4(&mesh.positions[t[2]].x);
        if constexpr (has_normals)
            put_normals(mesh, scene.shading[hit.geometry].normals, hit.primitive, k, normals_a, normals_b, normals_c);
    }
    const Vec3T<Float4> uv = turned(rows_uv), a = turned(rows_a), b = turned(rows_b), c = turned(rows_c);
    const PointOnTriangle<Float4> at(a, b, c, uv.x, uv.y);
    const Vec3T<Double4> e1 = to_double(b) - to_double(a), e2 = to_double(c) - to_double(a), cross_n = cross(e1, e2);
    const Double4 length_n = sqrt(dot(cross_n, cross_n));
    const Float4 zero{};
    // What is no number stands for a triangle without area, as for one alone.
    const Mask4f has_area = narrowed(length_n > Double4{});
    PlacesOfFour s{at.p, at.p_error, to_float(cross_n * (1.0 / length_n)), {}, _mm256_cvtpd_ps(0.5 * length_n)};
    s.n = select(has_area, s.n, Vec3T<Float4>{zero, zero, zero + 1.0f});
    s.ns = s.n;
    if constexpr (has_normals) {
        const Vec3T<Float4> na = turned(normals_a);
        const Mask4f smooth = na.x == na.x;
        const Vec3T<Double4> sum =
            to_double(na * at.first_weight + turned(normals_b) * uv.x + turned(normals_c) * uv.y);
        const Double4 length = sqrt(dot(sum, sum));
        s.ns = select(smooth & narrowed(length > Double4{}), to_float(sum * (1.0 / length)), s.ns);
        s.n = select(smooth & (dot(s.n, s.ns) < zero), -s.n, s.n);
    }
    return s;
}

}  // namespace

PlacesOfFour flat_places_of(const Scene& scene, std::span<const Hit> hits, const FourHits& which)
{
    return places<false>(scene, hits, which);
}

PlacesOfFour places_of(const Scene& scene, std::span<const Hit> hits, const FourHits& which)
{
    return scene.has_normals ? places<true>(scene, hits, which) : places<false>(scene, hits, which);
}

TrianglePlace triangle_place(const Scene& scene, uint32_t instance, uint32_t mesh_index, uint32_t triangle, Vec2 uv)
{
    const Mesh& mesh = scene.geometry.meshes[mesh_index];
    const auto& t = mesh.triangles[triangle];
    const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
    const PointOnTriangle<float> at(a, b, c, uv.x, uv.y);
    TrianglePlace s;
    s.p = at.p, s.p_error = at.p_error;
    const Vec3d e1 = to_double(b) - to_double(a), e2 = to_double(c) - to_double(a);
    Vec3d n = cross(e1, e2), ns;
    bool smooth = false;
    const MeshShading& shading = scene.shading[mesh_index];
    if (const auto* const corners = shading.normals.find(mesh, triangle)) {
        const auto normal = [&](size_t k) { return shading.normals.values[(*corners)[k]]; };
        ns = to_double(normal(0) * first_weight(uv) + normal(1) * uv.x + normal(2) * uv.y);
        smooth = true;
    }
    if (instance != Hit::no_instance) {
        const Instance& placing = scene.geometry.instances[instance];
        const Transform& m = placing.to_world;
        const Vec3d p = to_double(s.p);
        s.p = to_float(m.point(p));
        // Embree takes the ray into the mesh's space in float: its rounding there, seen from here, comes on top.
        const Vec3d there = spread(placing.to_mesh, abs(to_double(s.p))) + abs(placing.to_mesh.translation);
        const Vec3d here = spread(m, abs(p)) + abs(m.translation) + spread(m, there);
        s.p_error = to_float(spread(m, to_double(s.p_error)) + here * static_cast<double>(gamma(8)));
        n = placing.to_mesh.normal_by_inverse(n);
        ns = placing.to_mesh.normal_by_inverse(ns);
        s.area = static_cast<float>(0.5 * length(cross(m.vector(e1), m.vector(e2))));
    }
    const double ln = length(n);
    if (instance == Hit::no_instance) s.area = static_cast<float>(0.5 * ln);
    s.n = s.ns = ln > 0 ? to_float(n * (1 / ln)) : Vec3{0, 0, 1};
    if (!smooth) return s;
    if (const double lns = length(ns); lns > 0) s.ns = to_float(ns * (1 / lns));
    if (dot(s.n, s.ns) < 0) s.n = -s.n;  // the normals of the file say which side is the front
    return s;
}

void fetch_shading(const Scene& scene, std::span<const Hit> hits)
{
    if (!scene.has_tables || !outgrows_caches(scene.geometry)) return;
    const auto for_meshes = [&](const auto& f) {
        for (const Hit& hit : hits)
            if (hit.kind == Kind::triangle)
                f(scene.geometry.meshes[hit.geometry], scene.shading[hit.geometry], hit.primitive);
    };
    for_meshes([](const Mesh&, const MeshShading& s, uint32_t triangle) {
        if (!s.face_material.empty()) prefetch(s.face_material.where(triangle));
        if (!s.normals.triangles.empty()) prefetch(&s.normals.triangles[triangle]);
        if (!s.uv_triangles.empty()) prefetch(s.uv_triangles.guess(triangle));
    });
    for_meshes([](const Mesh& mesh, const MeshShading& s, uint32_t triangle) {
        const auto fetch = [](const auto& list, const auto& corners) {
            for (const uint32_t corner : corners) prefetch(&list[corner]);
        };
        // Not find(), which waits for the normal of a vertex to tell whether there is one.
        if (!s.normals.empty())
            if (const auto& corners = s.normals.named_by(mesh, triangle); corners[0] != CornerNormals::none)
                fetch(s.normals.values, corners);
        if (!s.uv_triangles.empty()) fetch(s.uvs, *s.uv_triangles.guess(triangle));
    });
}

void triangle_places(const Scene& scene, std::span<const Hit> hits, std::span<TrianglePlace> places)
{
    for_triangles(
        hits, [&](const FourHits& which) { put(places_of(scene, hits, which), which, places); },
        [&](size_t i) {
            places[i] = triangle_place(scene, hits[i].instance, hits[i].geometry, hits[i].primitive, hits[i].uv);
        });
}

}  // namespace lancer
