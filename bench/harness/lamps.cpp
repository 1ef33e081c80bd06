#include "harness/lamps.h"

#include <cmath>

#include "harness/generate.h"
#include "harness/stage.h"
#include "support/random.h"
#include "support/scenes/scenes.h"

namespace lancer::bench {
namespace {

// Triangles that face down, all of one radiance. size: of the sides at their right angles.
std::shared_ptr<const MeshData> make_lamps(const std::vector<Vec3d>& places, double size, float radiance)
{
    MeshData mesh;
    mesh.materials.push_back(make_emitter("lamp", Color{1, 1, 1} * radiance));
    for (const Vec3d& p : places) {
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        for (const Vec3d& corner : {p, p + Vec3d{size, 0, 0}, p + Vec3d{0, 0, size}}) mesh.positions.push_back(corner);
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return std::make_shared<const MeshData>(std::move(mesh));
}

// A box with these corners, seen from without or from within.
void add_box(MeshData& to, const Vec3d& low, const Vec3d& high, bool from_within)
{
    const auto first = static_cast<uint32_t>(to.positions.size());
    const MeshPointer cube = make_cube();
    for (const Vec3d& p : cube->positions)
        to.positions.push_back({p.x < 0 ? low.x : high.x, p.y < 0 ? low.y : high.y, p.z < 0 ? low.z : high.z});
    for (auto [a, b, c] : cube->triangles) {
        if (from_within) std::swap(b, c);
        to.triangles.push_back({first + a, first + b, first + c});
    }
}

}  // namespace

SceneDescription box_of_lamps(uint32_t lamps)
{
    const auto side = static_cast<uint32_t>(std::ceil(std::sqrt(lamps)));
    std::vector<Vec3d> places;
    for (uint32_t i = 0; i < lamps; ++i)
        places.push_back({1.9 * (i % side + 0.5) / side - 0.95, 0.99, 1.9 * (i / side + 0.5) / side - 0.95});
    SceneDescription d = describe_mesh(*make_room(20'000));
    d.camera->position = {0.9, 0.2, 0.95}, d.camera->target = {-0.4, -0.2, -0.5}, d.camera->fov_deg = 70;
    d.lights.clear();
    d.meshes.emplace_back().data = make_lamps(places, 0.006, 60000.0f / static_cast<float>(lamps));
    return d;
}

SceneDescription hall_of_lamps(uint32_t lamps)
{
    const auto row = static_cast<uint32_t>(std::lround(std::sqrt(lamps)));
    const double side = 2.0 * row;
    MeshData hall;
    add_box(hall, {0, 0, 0}, {side, 4, side}, true);
    Random random(3);
    for (double x = 0; x + 3 <= side; x += 3)
        for (double z = 0; z + 3 <= side; z += 3) {
            const double at_x = x + random.uniform(0, 2), at_z = z + random.uniform(0, 2);
            add_box(hall, {at_x, 0, at_z}, {at_x + 1, random.uniform(0.3, 2.5), at_z + 1}, false);
        }
    std::vector<Vec3d> places;
    for (uint32_t i = 0; i < lamps; ++i) places.push_back({2 * (i % row) + 0.9, 3.95, 2 * (i / row) + 0.9});
    SceneDescription d = describe_mesh(hall);
    d.camera->position = {0.1 * side, 3.2, 0.1 * side}, d.camera->target = {0.9 * side, 0, 0.9 * side};
    d.camera->fov_deg = 60;
    d.lights.clear();
    d.meshes.emplace_back().data = make_lamps(places, 0.3, 20);
    return d;
}

}  // namespace lancer::bench
