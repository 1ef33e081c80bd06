#include "scene/triangle_place.h"

#include "core/prefetch.h"
#include "geometry/triangle_lanes.h"
#include "scene/scene.h"

namespace lancer {
namespace {

// |M| v: how far an error per axis can reach through a linear map.
Vec3d spread(const Transform& m, Vec3d v) { return abs(m.x) * v.x + abs(m.y) * v.y + abs(m.z) * v.z; }

// Of those of four triangles whose corners have normals.
void interpolate_normals(const Scene& scene, std::span<const Hit> hits, const FourHits& which, PlacesOfFour& s)
{
    std::array<Float4, double_lanes> rows_a{}, rows_b{}, rows_c{};
    Float4 u, v;
    Mask4f smooth{};
    for (size_t k = 0; k < double_lanes; ++k) {
        const Hit& hit = hits[which[k]];
        u[k] = hit.uv.x, v[k] = hit.uv.y;
        const MeshShading& shading = scene.shading[hit.geometry];
        const auto* const corners = shading.normals.find(scene.geometry.meshes[hit.geometry], hit.primitive);
        if (!corners) continue;
        const auto normal = [&](uint32_t i) { return load4(&shading.normals.values[(*corners)[i]].x); };
        rows_a[k] = normal(0), rows_b[k] = normal(1), rows_c[k] = normal(2);
        smooth[k] = -1;
    }
    if (bits(smooth) == 0) return;
    const Float4 w = first_weight(u, v);
    const Vec3T<Double4> sum = to_double(turned(rows_a) * w + turned(rows_b) * u + turned(rows_c) * v);
    const Double4 length = sqrt(dot(sum, sum));
    s.ns = select(smooth & narrowed(length > Double4{}), to_float(sum * (1.0 / length)), s.ns);
    s.n = select(smooth & (dot(s.n, s.ns) < Float4{}), -s.n, s.n);
}

}  // namespace

PlacesOfFour flat_places_of(const Scene& scene, std::span<const Hit> hits, const FourHits& which)
{
    std::array<Float4, double_lanes> rows_a, rows_b, rows_c;
    Float4 u, v;
    for (size_t k = 0; k < double_lanes; ++k) {
        const Hit& hit = hits[which[k]];
        const Mesh& mesh = scene.geometry.meshes[hit.geometry];
        const auto& t = mesh.triangles[hit.primitive];
        rows_a[k] = load4(&mesh.positions[t[0]].x);
        rows_b[k] = load4(&mesh.positions[t[1]].x);
        rows_c[k] = load4(&mesh.positions[t[2]].x);
        u[k] = hit.uv.x, v[k] = hit.uv.y;
    }
    const Vec3T<Float4> a = turned(rows_a), b = turned(rows_b), c = turned(rows_c);
    const PointOnTriangle<Float4> at(a, b, c, u, v);
    const Vec3T<Double4> e1 = to_double(b) - to_double(a), e2 = to_double(c) - to_double(a), cross_n = cross(e1, e2);
    const Double4 length_n = sqrt(dot(cross_n, cross_n));
    const Float4 zero{};
    // What is no number stands for a triangle without area, as for one alone.
    const Mask4f has_area = narrowed(length_n > Double4{});
    PlacesOfFour s{at.p, at.p_error, to_float(cross_n * (1.0 / length_n)), {}, _mm256_cvtpd_ps(0.5 * length_n)};
    s.n = select(has_area, s.n, Vec3T<Float4>{zero, zero, zero + 1.0f});
    s.ns = s.n;
    return s;
}

PlacesOfFour places_of(const Scene& scene, std::span<const Hit> hits, const FourHits& which)
{
    PlacesOfFour s = flat_places_of(scene, hits, which);
    if (scene.has_normals) interpolate_normals(scene, hits, which, s);
    return s;
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
