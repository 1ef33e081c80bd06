#include "scene/build/planar_mirrors.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "core/frame.h"
#include "materials/material.h"

namespace lancer {
namespace {

constexpr size_t most_mirrors = 4;
constexpr double least_of_bounds = 1.0 / 256, least_of_largest = 1.0 / 16;
// Triangles of one plane have normals and offsets that agree to this part of 1 and of the scene's extent. It decides
// what is taken for one mirror only; each triangle reflects by its own normal.
constexpr double grain = 0x1p-16;
// Vertex normals that differ from the face's by more, as 1 - cosine, make a mirror curved.
constexpr double flat_mirror = 0x1p-23;

// Whether a material reflects like a mirror everywhere, and nothing else.
bool is_mirror(const Scene& scene, uint32_t id)
{
    if (!scene.mix_of.empty() && scene.mix_of[id] != Scene::none) return false;
    if (scene.traits[id].tilts() || !scene.emission[id].is_dark()) return false;
    if (std::holds_alternative<Mirror>(scene.materials[id])) return true;
    const auto* const metal = std::get_if<Metal>(&scene.materials[id]);
    return metal && metal->roughness.texture == no_texture && alpha_of_roughness(metal->roughness.value) == 0;
}

struct Triangle {
    Vec3d corner[3];
    Vec3d n{};
    double area = 0;

    // placed: of an instance; null: as the mesh has it.
    Triangle(const Mesh& mesh, uint32_t id, const Transform* placed = nullptr)
    {
        for (size_t i = 0; i < 3; ++i) {
            corner[i] = to_double(mesh.positions[mesh.triangles[id][i]]);
            if (placed) corner[i] = placed->point(corner[i]);
        }
        const Vec3d c = cross(corner[1] - corner[0], corner[2] - corner[0]);
        const double twice = length(c);
        if (twice > 0) n = c / twice, area = 0.5 * twice;
    }
};

// n: of the triangle in the mesh's own space, where an instance is as flat.
bool is_flat(const MeshShading& shading, const Mesh& mesh, uint32_t id, Vec3d n)
{
    const CornerNormals::Corners* const named = shading.normals.find(mesh, id);
    return !named || std::all_of(named->begin(), named->end(), [&](uint32_t i) {
        const Vec3d corner = to_double(shading.normals.value(mesh, i));
        return std::abs(dot(corner, n)) >= (1 - flat_mirror) * length(corner);
    });
}

double area_of(const Bounds& b)
{
    const Vec3d side = b.upper - b.lower;
    return b.empty() ? 0 : 2 * (side.x * side.y + side.y * side.z + side.z * side.x);
}

// Triangles of a mesh in a plane.
struct Group {
    uint32_t mesh = 0, instance = Hit::no_instance;
    std::vector<uint32_t> triangles;
    double area = 0;
};
bool is_larger(const Group& a, const Group& b) { return a.area > b.area; }

// The plane of a triangle in whole steps of the grain; a plane and its reverse are one.
std::tuple<int64_t, int64_t, int64_t, int64_t> key_of(const Triangle& t, double extent)
{
    const bool turned = std::tie(t.n.x, t.n.y, t.n.z) < std::make_tuple(-t.n.x, -t.n.y, -t.n.z);
    const Vec3d n = turned ? -t.n : t.n;
    const auto steps = [](double x) { return std::llround(x / grain); };
    return {steps(n.x), steps(n.y), steps(n.z), steps(dot(n, t.corner[0]) / extent)};
}

// The largest groups of a mesh, in its own space.
std::vector<Group> groups_of(const Scene& scene, uint32_t m, const std::vector<bool>& mirrors)
{
    const MeshShading& shading = scene.shading[m];
    const Mesh& mesh = scene.geometry.meshes[m];
    if (!shading.uses([&](uint32_t id) { return mirrors[id]; })) return {};
    // An instanced mesh is in a frame of its own, of an extent from 1 to 2.
    const double extent = mesh.instanced ? 1 : scene.bounds.extent();
    std::map<std::tuple<int64_t, int64_t, int64_t, int64_t>, Group> by_plane;
    for (uint32_t id = 0; id < mesh.triangles.size(); ++id) {
        if (!mirrors[shading.material_of(id)]) continue;
        const Triangle t(mesh, id);
        if (t.area == 0 || !is_flat(shading, mesh, id, t.n)) continue;
        Group& group = by_plane[key_of(t, extent)];
        group.mesh = m, group.area += t.area;
        group.triangles.push_back(id);
    }
    std::vector<Group> all;
    for (auto& [key, group] : by_plane) all.push_back(std::move(group));
    std::stable_sort(all.begin(), all.end(), is_larger);
    if (all.size() > most_mirrors) all.resize(most_mirrors);
    return all;
}

// Those of all meshes, and of instances where they are placed, that are large enough.
std::vector<Group> groups_of(const Scene& scene, const std::vector<bool>& mirrors)
{
    const double least = least_of_bounds * area_of(scene.bounds);
    std::vector<Group> all;
    std::vector<std::vector<Group>> of_instanced(scene.shading.size());
    for (uint32_t m = 0; m < scene.shading.size(); ++m)
        for (Group& group : groups_of(scene, m, mirrors)) {
            if (scene.geometry.meshes[m].instanced)
                of_instanced[m].push_back(std::move(group));
            else if (group.area >= least)
                all.push_back(std::move(group));
        }
    for (uint32_t i = 0; i < scene.geometry.instances.size(); ++i) {
        const Instance& placed = scene.geometry.instances[i];
        if (is_moving(scene.geometry.motion.instances, i)) continue;
        for (const Group& group : of_instanced[placed.mesh]) {
            const Triangle first(scene.geometry.meshes[group.mesh], group.triangles[0]);
            const double area = group.area * std::abs(placed.to_world.determinant()) *
                                length(placed.to_mesh.normal_by_inverse(first.n));
            if (area >= least) all.push_back({group.mesh, i, group.triangles, area});
        }
    }
    return all;
}

PlanarMirror mirror_of(const Geometry& geometry, const Group& group)
{
    const Mesh& mesh = geometry.meshes[group.mesh];
    const Transform* const placed =
        group.instance == Hit::no_instance ? nullptr : &geometry.instances[group.instance].to_world;
    const Triangle first(mesh, group.triangles[0], placed);
    const Vec3d n = first.n, u = normalize(first.corner[1] - first.corner[0]), v = cross(n, u);
    PlanarMirror m{
        .p = to_float(first.corner[0]), .n = to_float(n), .u = to_float(u), .v = to_float(v), .low = {}, .high = {}};
    for (const uint32_t id : group.triangles)
        for (const Vec3d& corner : Triangle(mesh, id, placed).corner) {
            const Vec3 at = to_float(corner) - m.p;
            const float x = dot(at, m.u), y = dot(at, m.v);
            m.low = {std::min(m.low.x, x), std::min(m.low.y, y)};
            m.high = {std::max(m.high.x, x), std::max(m.high.y, y)};
        }
    // Room for the rounding of a crossing: light at the very edge is looked for rather than missed.
    const Vec2 room = (m.high - m.low) * static_cast<float>(grain);
    m.low = m.low - room, m.high = m.high + room;
    return m;
}

}  // namespace

void find_planar_mirrors(Scene& scene)
{
    const bool has_images = std::any_of(scene.lights.lights.begin(), scene.lights.lights.end(), [](const Light& light) {
        return !std::holds_alternative<EnvironmentLight>(light);
    });
    if (!has_images || scene.legacy || !scene.media.empty()) return;
    std::vector<bool> mirrors;
    for (uint32_t id = 0; id < scene.materials.size(); ++id) mirrors.push_back(is_mirror(scene, id));
    if (std::find(mirrors.begin(), mirrors.end(), true) == mirrors.end()) return;

    std::vector<Group> groups = groups_of(scene, mirrors);
    std::stable_sort(groups.begin(), groups.end(), is_larger);
    for (const Group& group : groups) {
        if (scene.mirrors.size() == most_mirrors || group.area < least_of_largest * groups[0].area) break;
        const bool is_placed = group.instance != Hit::no_instance;
        if (is_placed) scene.instance_mirror_of.resize(scene.geometry.instances.size());
        std::vector<uint8_t>& of =
            is_placed ? scene.instance_mirror_of[group.instance] : scene.shading[group.mesh].mirror_of;
        of.resize(scene.geometry.meshes[group.mesh].triangles.size());
        scene.mirrors.push_back(mirror_of(scene.geometry, group));
        for (const uint32_t id : group.triangles) of[id] = static_cast<uint8_t>(scene.mirrors.size());
    }
}

}  // namespace lancer
