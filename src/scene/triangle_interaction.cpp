#include "scene/triangle_interaction.h"

#include "core/lanes/prefetch.h"
#include "geometry/triangle_lanes.h"
#include "scene/scene.h"

namespace lancer {
namespace {

// |M| v: bound of an error per axis after a linear map.
Vec3d spread(const Transform& m, Vec3d v) { return abs(m.x) * v.x + abs(m.y) * v.y + abs(m.z) * v.z; }

using Rows = std::array<Float4, float_lanes>;  // what stands in memory of eight places
Vec3x8 turned(const Rows& rows)
{
    return transpose([&](size_t i) { return rows[i]; }).xyz;
}

// Corner normals of eight triangles, each followed by another number; CornerNormals::of_flat() for flat ones.
struct NormalRows {
    std::array<Rows, 3> corners;

    void put(size_t k, const Mesh& mesh, const CornerNormals& normals, uint32_t triangle)
    {
        for (Rows& rows : corners) rows[k] = Float4{} + CornerNormals::of_flat().x;
        if (normals.empty()) return;
        const auto& named = normals.named_by(mesh, triangle);
        if (named[0] == CornerNormals::none) return;
        for (size_t c = 0; c < 3; ++c) corners[c][k] = normals.row(mesh, named[c]);
    }
};

// Normalises eight vectors in double.
struct UnitLanes {
    Vec3x8 v;
    Float8 half_length;
    Mask8 exist;  // a vector without length has none

    UnitLanes(const Vec3T<Double4>& low, const Vec3T<Double4>& high)
    {
        const Double4 low_length = length(low), high_length = length(high), zero{};
        v = concat(to_float(low * (1.0 / low_length)), to_float(high * (1.0 / high_length)));
        half_length = concat(to_float(0.5 * low_length), to_float(0.5 * high_length));
        exist = concat(narrow(low_length > zero), narrow(high_length > zero));
    }
    explicit UnitLanes(const Vec3x8& a) : UnitLanes(to_double(lower(a)), to_double(upper(a))) {}
};

Vec3T<Double4> normal_of(const Vec3T<Float4>& a, const Vec3T<Float4>& b, const Vec3T<Float4>& c)
{
    return cross(to_double(b) - to_double(a), to_double(c) - to_double(a));
}

template <bool has_normals>
InteractionLanes places(const Scene& scene, std::span<const Hit> hits, const HitIndices& which)
{
    Rows rows_uv, rows_a, rows_b, rows_c;
    NormalRows normals;
    for (size_t k = 0; k < float_lanes; ++k) {
        const Hit& hit = hits[which[k]];
        const Mesh& mesh = scene.geometry.meshes[hit.geometry];
        const auto& t = mesh.triangles[hit.primitive];
        rows_uv[k] = load4(&hit.uv.x);
        rows_a[k] = load4(&mesh.positions[t[0]].x);
        rows_b[k] = load4(&mesh.positions[t[1]].x);
        rows_c[k] = load4(&mesh.positions[t[2]].x);
        if constexpr (has_normals) normals.put(k, mesh, scene.shading[hit.geometry].normals, hit.primitive);
    }
    const Vec3x8 uv = turned(rows_uv), a = turned(rows_a), b = turned(rows_b), c = turned(rows_c);
    const PointOnTriangle<Float8> at(a, b, c, uv.x, uv.y);
    const UnitLanes flat(normal_of(lower(a), lower(b), lower(c)), normal_of(upper(a), upper(b), upper(c)));
    const Float8 zero{};
    // NaN: a triangle without area, as in the scalar function.
    InteractionLanes s{
        at.p, at.p_error, select(flat.exist, flat.v, Vec3x8{zero, zero, zero + 1.0f}), {}, flat.half_length};
    s.ns = s.n;
    if constexpr (has_normals) {
        const Vec3x8 na = turned(normals.corners[0]);
        const Mask8 is_smooth = na.x == na.x;
        const UnitLanes smooth(na * at.first_weight + turned(normals.corners[1]) * uv.x +
                               turned(normals.corners[2]) * uv.y);
        s.ns = select(is_smooth & smooth.exist, smooth.v, s.ns);
        s.n = select(is_smooth & (dot(s.n, s.ns) < zero), -s.n, s.n);
    }
    return s;
}

// Addresses of the corners' data; for triangles without it any address, which is harmless.
template <class T, class Corners>
void fetch(const std::vector<T>& values, const Corners& corners)
{
    for (const uint32_t corner : corners) prefetch(values.data() + corner);
}
// Vertex normals were loaded with the positions.
void prefetch_normals(const MeshShading& s, uint32_t triangle)
{
    if (!s.normals.values.empty()) fetch(s.normals.values, s.normals.triangles[triangle]);
}
void prefetch_uvs(const MeshShading& s, uint32_t triangle)
{
    if (!s.uv_triangles.empty()) fetch(s.uvs, *s.uv_triangles.guess(triangle));
}

}  // namespace

InteractionLanes flat_interactions_of(const Scene& scene, std::span<const Hit> hits, const HitIndices& which)
{
    return places<false>(scene, hits, which);
}

InteractionLanes interactions_of(const Scene& scene, std::span<const Hit> hits, const HitIndices& which)
{
    return scene.has_normals ? places<true>(scene, hits, which) : places<false>(scene, hits, which);
}

TriangleInteraction triangle_interaction(const Scene& scene, uint32_t instance, uint32_t mesh_index, uint32_t triangle,
                                         Vec2 uv, float time)
{
    const Mesh& mesh = scene.geometry.meshes[mesh_index];
    const auto& t = mesh.triangles[triangle];
    const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
    const PointOnTriangle<float> at(a, b, c, uv.x, uv.y);
    TriangleInteraction s;
    s.p = at.p, s.p_error = at.p_error;
    const Vec3d e1 = to_double(b) - to_double(a), e2 = to_double(c) - to_double(a);
    Vec3d n = cross(e1, e2), ns;
    bool smooth = false;
    const MeshShading& shading = scene.shading[mesh_index];
    if (const auto* const corners = shading.normals.find(mesh, triangle)) {
        const auto normal = [&](size_t k) { return shading.normals.value(mesh, (*corners)[k]); };
        ns = to_double(normal(0) * first_weight(uv) + normal(1) * uv.x + normal(2) * uv.y);
        smooth = true;
    }
    if (instance != Hit::no_instance) {
        const InstanceAt at_time = scene.geometry.instance_at(instance, time);
        const Instance& placing = *at_time;
        const Transform& m = placing.to_world;
        const Vec3d p = to_double(s.p);
        s.p = to_float(m.point(p));
        // Embree transforms the ray into the mesh's space in float; that rounding error, seen from here, is added.
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

bool tables_exceed_caches(const Scene& scene) { return scene.has_tables && exceeds_caches(scene.geometry); }

void prefetch_shading(const Scene& scene, std::span<const Hit> hits)
{
    for (const Hit& hit : hits) {
        if (hit.kind != Kind::triangle) continue;
        const MeshShading& s = scene.shading[hit.geometry];
        if (!s.face_material.empty()) prefetch(s.face_material.where(hit.primitive));
        if (!s.normals.triangles.empty()) prefetch(&s.normals.triangles[hit.primitive]);
    }
}

void prefetch_normals(const Scene& scene, std::span<const Hit> hits, uint32_t which)
{
    for_each_lane(which, [&](uint32_t i) { prefetch_normals(scene.shading[hits[i].geometry], hits[i].primitive); });
}

void prefetch_uv_corners(const Scene& scene, std::span<const Hit> hits, uint32_t which)
{
    for_each_lane(which, [&](uint32_t i) {
        const CornerTable& corners = scene.shading[hits[i].geometry].uv_triangles;
        if (!corners.empty()) prefetch(corners.guess(hits[i].primitive));
    });
}

void prefetch_uvs(const Scene& scene, std::span<const Hit> hits, uint32_t which)
{
    for_each_lane(which, [&](uint32_t i) { prefetch_uvs(scene.shading[hits[i].geometry], hits[i].primitive); });
}

void prefetch_all(const Scene& scene, std::span<const Hit> hits)
{
    prefetch_shading(scene, hits);
    for (const Hit& hit : hits) {
        if (hit.kind != Kind::triangle) continue;
        const MeshShading& s = scene.shading[hit.geometry];
        prefetch_normals(s, hit.primitive), prefetch_uvs(s, hit.primitive);
    }
}

void triangle_interactions(const Scene& scene, std::span<const Ray> rays, std::span<const Hit> hits,
                           std::span<TriangleInteraction> places)
{
    for_triangles<float_lanes>(
        hits, [&](const HitIndices& which) { put(interactions_of(scene, hits, which), which, places); },
        [&](size_t i) {
            places[i] = triangle_interaction(scene, hits[i].instance, hits[i].geometry, hits[i].primitive, hits[i].uv,
                                             rays[i].time);
        });
}

}  // namespace lancer
