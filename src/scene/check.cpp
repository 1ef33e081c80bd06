#include "scene/check.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/frame.h"
#include "core/names.h"

namespace lancer {
namespace {

// Number of triangles with the same corners as an earlier one, in any order.
uint64_t count_repeated(const std::vector<std::array<uint32_t, 3>>& triangles)
{
    std::vector<std::array<uint32_t, 3>> sorted;
    sorted.reserve(triangles.size());
    for (auto t : triangles) {
        std::sort(t.begin(), t.end());
        sorted.push_back(t);
    }
    std::sort(sorted.begin(), sorted.end());
    uint64_t repeated = 0;
    for (size_t i = 1; i < sorted.size(); ++i)
        if (sorted[i] == sorted[i - 1]) ++repeated;
    return repeated;
}

void check_mesh(const MeshData& data, Diagnostics& problems, Diagnostics& notes)
{
    uint64_t flipped = 0, with_normals = 0;
    for (size_t i = 0; i < data.normal_triangles.size(); ++i) {
        const auto& normals = data.normal_triangles[i];
        if (normals[0] == MeshData::no_normal) continue;
        ++with_normals;
        const auto& t = data.triangles[i];
        const Vec3d a = data.positions[t[0]];
        const Vec3d n = cross(data.positions[t[1]] - a, data.positions[t[2]] - a);
        const auto faces_away = [&](uint32_t normal) { return dot(n, to_double(data.normals[normal])) < 0; };
        if (faces_away(normals[0]) && faces_away(normals[1]) && faces_away(normals[2])) ++flipped;
    }
    const std::string of_all = " of " + std::to_string(data.triangles.size()) + " triangles";
    if (flipped)
        problems.warning({data.file}, "vertex normals point away from the side that the winding shows in " +
                                          std::to_string(flipped) + of_all + "; they are turned round while rendering");
    if (data.made_normals)
        notes.warning({data.file}, "no vertex normals: made by smoothing groups or `smooth` in " +
                                       std::to_string(with_normals) + of_all);
    if (with_normals == 0) {
        notes.warning({data.file}, "no vertex normals: faces are flat");
    } else if (with_normals < data.triangles.size() && !data.made_normals) {
        notes.warning({data.file}, "no vertex normals in " + std::to_string(data.triangles.size() - with_normals) +
                                       of_all + ": they are flat");
    }
    if (const uint64_t twice = count_repeated(data.triangles))
        notes.warning({data.file}, "the corners of another triangle in " + std::to_string(twice) + of_all);
    for (const MaterialDescription& m : data.materials)
        if (m.is_doubtful) notes.warning(m.where, std::string(name_of(m.type)) + ", by " + m.why);
}

// An emitter for the test: the triangles of a mesh that share a material.
struct Emitter {
    uint32_t instance = Hit::no_instance, mesh = 0, material = 0;
    std::vector<uint32_t> triangles;
};

std::vector<Emitter> one_sided_emitters(const Scene& scene)
{
    std::vector<uint32_t> first_instance(scene.geometry.meshes.size(), Hit::no_instance);
    for (uint32_t i = 0; i < scene.geometry.instances.size(); ++i) {
        uint32_t& first = first_instance[scene.geometry.instances[i].mesh];
        if (first == Hit::no_instance) first = i;
    }
    std::vector<Emitter> emitters;
    for (uint32_t m = 0; m < scene.geometry.meshes.size(); ++m) {
        const Mesh& mesh = scene.geometry.meshes[m];
        if (mesh.instanced && first_instance[m] == Hit::no_instance) continue;
        std::map<uint32_t, Emitter> by_material;
        for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const uint32_t material = scene.shading[m].material_of(t);
            if (scene.emission[material].is_dark() || scene.emission[material].both_sides) continue;
            Emitter& e = by_material[material];
            e.instance = first_instance[m], e.mesh = m, e.material = material;
            e.triangles.push_back(t);
        }
        for (auto& [material, emitter] : by_material) emitters.push_back(std::move(emitter));
    }
    return emitters;
}

struct Surroundings {
    bool blocked_front = true, blocked_back = true;  // right in front of, behind every place looked at
    bool sees_only_itself = true;                    // along every ray on the front side
};

// Tests rays from points spread over the emitter, along the normal and slanted.
Surroundings look_around(const Scene& scene, const Accelerator& accel, const Emitter& e)
{
    constexpr size_t most_places = 64;
    constexpr float near = 0.02f;  // of the emitter's size: what is closer is a wall that it was put on
    Bounds bounds;
    const auto at = [&](uint32_t triangle) {
        return triangle_point(scene, e.instance, e.mesh, triangle, {1 / 3.0f, 1 / 3.0f});
    };
    const size_t step = (e.triangles.size() + most_places - 1) / most_places;
    float size = 0;
    for (size_t i = 0; i < e.triangles.size(); i += step) {
        const TrianglePoint place = at(e.triangles[i]);
        bounds.grow(to_double(place.p));
        size = std::max(size, std::sqrt(place.area));
    }
    size = std::max(size, static_cast<float>(bounds.extent()));

    Surroundings result;
    const auto hit_along = [&](const TrianglePoint& place, Vec3 dir) {
        return accel.closest(Ray{.org = offset_origin(place.p, place.p_error, place.n, dir), .dir = dir});
    };
    const auto is_itself = [&](const Hit& h) {
        return h && h.kind == Kind::triangle && h.geometry == e.mesh &&
               scene.shading[e.mesh].material_of(h.primitive) == e.material;
    };
    for (size_t i = 0; i < e.triangles.size(); i += step) {
        const TrianglePoint place = at(e.triangles[i]);
        const Frame frame(place.n);
        const Hit front = hit_along(place, place.n), back = hit_along(place, -place.n);
        result.blocked_front = result.blocked_front && front && front.t < near * size;
        result.blocked_back = result.blocked_back && back && back.t < near * size;
        for (const Vec3 slanted :
             {Vec3{0, 0, 1}, Vec3{0.6f, 0, 0.8f}, Vec3{-0.3f, 0.52f, 0.8f}, Vec3{-0.3f, -0.52f, 0.8f}})
            result.sees_only_itself =
                result.sees_only_itself && is_itself(hit_along(place, frame.to_world(normalize(slanted))));
    }
    return result;
}

// The place in the file of a material.
Location place_of_material(const SceneDescription& d, const std::string& name, uint32_t mesh)
{
    for (const MaterialDescription& m : d.materials)
        if (m.name == name) return m.where;
    for (const MaterialDescription& m : d.meshes[mesh].data->materials)
        if (m.name == name) return m.where;
    return d.meshes[mesh].where;
}

}  // namespace

void check_description(const SceneDescription& d, Diagnostics& problems, Diagnostics& notes)
{
    std::set<const MeshData*> seen;
    for (const MeshDescription& mesh : d.meshes)
        if (mesh.data && mesh.data->shape.empty() && seen.insert(mesh.data.get()).second)
            check_mesh(*mesh.data, problems, notes);
    if (!d.camera) notes.warning({d.file}, "no camera: one that sees the whole scene is added");
}

void check_texture_coordinates(const SceneDescription& d, const Scene& scene, Diagnostics& problems)
{
    for (size_t i = 0; i < scene.shading.size(); ++i) {
        const MeshShading& s = scene.shading[i];
        const auto triangles = static_cast<uint32_t>(scene.geometry.meshes[i].triangles.size());
        uint64_t textured = 0, lacking = 0;
        for (uint32_t t = 0; t < triangles; ++t) {
            if (!scene.traits[s.material_of(t)].reads_uv) continue;
            ++textured;
            if (!s.uv_triangles.find(t)) ++lacking;
        }
        if (lacking)
            problems.warning({d.meshes[i].data->file}, "no texture coordinates in " + std::to_string(lacking) + " of " +
                                                           std::to_string(textured) +
                                                           " triangles with textures: each has the colour of a corner "
                                                           "of the picture");
    }
}

void check_emitters(const SceneDescription& d, const Scene& scene, const Accelerator& accel, Diagnostics& problems)
{
    for (const Emitter& e : one_sided_emitters(scene)) {
        const Surroundings view = look_around(scene, accel, e);
        const std::string& name = scene.material_names[e.material];
        const Location where = place_of_material(d, name, e.mesh);
        const std::string advice = "; turn its faces round, or let it emit on both sides";
        if (view.blocked_front && !view.blocked_back)
            problems.warning(where, "emitter " + in_quotes(name) + " faces only a wall at its back" + advice);
        else if (view.sees_only_itself)
            problems.warning(where, "emitter " + in_quotes(name) + " lights only its own inside" + advice);
    }
}

}  // namespace lancer
