#include "scene/build/planar_mirrors.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "core/frame.h"

namespace lancer {
namespace {

constexpr size_t most_mirrors = 4;
constexpr double least_of_bounds = 1.0 / 256, least_of_largest = 1.0 / 16;
// Triangles of one plane have normals and offsets that agree to this part of 1 and of the scene's extent. It decides
// what is taken for one mirror only; each triangle reflects by its own normal.
constexpr double grain = 0x1p-16;
// Vertex normals that differ from the face's by more, as 1 - cosine, make a mirror curved.
constexpr double flat = 0x1p-23;

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

    Triangle(const Mesh& mesh, uint32_t id)
    {
        for (size_t i = 0; i < 3; ++i) corner[i] = to_double(mesh.positions[mesh.triangles[id][i]]);
        const Vec3d c = cross(corner[1] - corner[0], corner[2] - corner[0]);
        const double twice = length(c);
        if (twice > 0) n = c / twice, area = 0.5 * twice;
    }
};

bool is_flat(const MeshShading& shading, const Mesh& mesh, uint32_t id, Vec3d n)
{
    const CornerNormals::Corners* const named = shading.normals.find(mesh, id);
    return !named || std::all_of(named->begin(), named->end(), [&](uint32_t i) {
        const Vec3d corner = to_double(shading.normals.value(mesh, i));
        return std::abs(dot(corner, n)) >= (1 - flat) * length(corner);
    });
}

double area_of(const Bounds& b)
{
    const Vec3d side = b.upper - b.lower;
    return b.empty() ? 0 : 2 * (side.x * side.y + side.y * side.z + side.z * side.x);
}

// Triangles of a mesh in a plane.
struct Group {
    uint32_t mesh = 0;
    std::vector<uint32_t> triangles;
    double area = 0;
};

// The plane of a triangle in whole steps of the grain; a plane and its reverse are one.
std::tuple<int64_t, int64_t, int64_t, int64_t> key_of(const Triangle& t, double extent)
{
    const bool turned = std::tie(t.n.x, t.n.y, t.n.z) < std::make_tuple(-t.n.x, -t.n.y, -t.n.z);
    const Vec3d n = turned ? -t.n : t.n;
    const auto steps = [](double x) { return std::llround(x / grain); };
    return {steps(n.x), steps(n.y), steps(n.z), steps(dot(n, t.corner[0]) / extent)};
}

std::vector<Group> groups_of(const Scene& scene, const std::vector<bool>& mirrors, double extent)
{
    std::vector<Group> all;
    for (uint32_t m = 0; m < scene.shading.size(); ++m) {
        const MeshShading& shading = scene.shading[m];
        const Mesh& mesh = scene.geometry.meshes[m];
        if (mesh.instanced || !shading.uses([&](uint32_t id) { return mirrors[id]; })) continue;
        std::map<std::tuple<int64_t, int64_t, int64_t, int64_t>, Group> by_plane;
        for (uint32_t id = 0; id < mesh.triangles.size(); ++id) {
            if (!mirrors[shading.material_of(id)]) continue;
            const Triangle t(mesh, id);
            if (t.area == 0 || !is_flat(shading, mesh, id, t.n)) continue;
            Group& group = by_plane[key_of(t, extent)];
            group.mesh = m, group.area += t.area;
            group.triangles.push_back(id);
        }
        for (auto& [key, group] : by_plane) all.push_back(std::move(group));
    }
    return all;
}

PlanarMirror mirror_of(const Mesh& mesh, const Group& group)
{
    const Triangle first(mesh, group.triangles[0]);
    const Vec3d n = first.n, u = normalize(first.corner[1] - first.corner[0]), v = cross(n, u);
    PlanarMirror m{
        .p = to_float(first.corner[0]), .n = to_float(n), .u = to_float(u), .v = to_float(v), .low = {}, .high = {}};
    for (const uint32_t id : group.triangles)
        for (const Vec3d& corner : Triangle(mesh, id).corner) {
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

    std::vector<Group> groups = groups_of(scene, mirrors, scene.bounds.extent());
    std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) { return a.area > b.area; });
    for (const Group& group : groups) {
        if (scene.mirrors.size() == most_mirrors || group.area < least_of_bounds * area_of(scene.bounds) ||
            group.area < least_of_largest * groups[0].area)
            break;
        std::vector<uint8_t>& of = scene.shading[group.mesh].mirror_of;
        of.resize(scene.geometry.meshes[group.mesh].triangles.size());
        scene.mirrors.push_back(mirror_of(scene.geometry.meshes[group.mesh], group));
        for (const uint32_t id : group.triangles) of[id] = static_cast<uint8_t>(scene.mirrors.size());
    }
}

}  // namespace lancer
