#include "scene/build/shapes.h"

#include <cmath>
#include <utility>

#include "core/hash.h"
#include "core/names.h"
#include "scene/build/material_table.h"
#include "scene/description/material.h"

namespace lancer {
namespace {

// For triangles that count their own corners as Rim does.
const std::vector<Vec2> corner_uvs{{0, 1}, {1, 1}, {0, 0}};

MaterialDescription clear_water()
{
    MaterialDescription m = default_description(MaterialType::glass);
    m.name = "water";
    m.ior = 1.33f;
    return m;
}

}  // namespace

std::array<Vec3d, 2> default_axes(Vec3d n)
{
    const Vec3d u = std::abs(n.y) > 0.9 ? normalize(Vec3d{n.y, -n.x, 0}) : normalize(cross(Vec3d{0, 1, 0}, n));
    return {u, cross(n, u)};
}

PlaneMap make_plane_map(const PlaneDescription& plane)
{
    const Vec3d n = normalize(plane.normal);
    PlaneMap map;
    if (!plane.axes) {
        const auto [u, v] = default_axes(n);
        map.u = map.step_u = u, map.v = map.step_v = v;
        return map;
    }
    map.origin = plane.point;
    const auto [u, v] = *plane.axes;
    map.u = u / dot(u, u), map.v = v / dot(v, v);
    const double volume = dot(cross(map.u, map.v), n);
    map.step_u = cross(map.v, n) / volume, map.step_v = cross(n, map.u) / volume;
    return map;
}

std::vector<Wave> default_waves(bool legacy)
{
    std::vector<Wave> waves{{0.20, 0.15, 1.6, 0},   {0.18, 2.0, 2.1, 0.5}, {0.12, 1.5, 3.7, 1.5}, {0.15, 2.8, 2.2, 0.7},
                            {0.07, 1.15, 1.3, 2.6}, {0.05, 0.71, 3, 2},    {0.08, 1.6, 2, 0.25},  {1, 0.44, 15.2, 0.1}};
    if (!legacy)
        for (Wave& w : waves) w.amplitude /= 2 * pi_d;
    return waves;
}

std::optional<MaterialDescription> inside_out(MaterialDescription m)
{
    if (!has_parameter(m.type, "absorption") || m.thin.value_or(false)) return {};
    if (m.type == MaterialType::principled && m.transmission == 0) return {};
    if (has_parameter(m.type, "outside_ior"))
        std::swap(m.phong.inside_ior, m.phong.outside_ior);
    else
        m.ior = 1 / m.ior;
    return m;
}

std::shared_ptr<const MeshData> make_triangle(Vec3d a, Vec3d b, Vec3d c)
{
    MeshData data;
    data.shape = "triangle";
    data.positions = {a, b, c};
    data.triangles = data.uv_triangles = {{0, 1, 2}};
    data.uvs = corner_uvs;
    return std::make_shared<const MeshData>(std::move(data));
}

std::shared_ptr<const MeshData> make_pyramid(Vec3d center, double side, Vec3d up)
{
    const Vec3d n = normalize(up / max_component(abs(up)));
    // As near to the axes as may be.
    const Vec3d second = normalize(std::abs(n.x) > 0.9 ? cross(n, Vec3d{0, 1, 0}) : cross(n, Vec3d{1, 0, 0}));
    const Vec3d x = cross(second, n) * (0.5 * side), y = second * (0.5 * side);
    MeshData data;
    data.shape = "pyramid";
    data.positions = {center - x - y, center + x - y, center + x + y, center - x + y,
                      center + n * (std::sqrt(0.5) * side)};
    data.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    data.uvs = corner_uvs;
    data.uv_triangles.assign(4, {0, 1, 2});
    return std::make_shared<const MeshData>(std::move(data));
}

// "glass or interface"
static std::string types_with_inside()
{
    std::string names;
    for (const MaterialType type : types_with("absorption"))
        names += (names.empty() ? "" : " or ") + std::string(name_of(type));
    return names;
}

uint32_t material_of(const SphereDescription& s, MaterialTable& materials, Diagnostics& diagnostics)
{
    if (s.part != SphereDescription::Part::inside_of_bubble) return materials.named(s.material, s.where);
    return materials.changed(s.material, s.where, "inside out", {}, [&](const MaterialDescription& m) {
        const std::optional<MaterialDescription> turned = inside_out(m);
        if (!turned)
            diagnostics.error(s.where,
                              "a bubble must be of a material of type " + types_with_inside() + "; " +
                                  (s.material.empty() ? "it has none"
                                                      : in_quotes(s.material) + (m.thin ? " is thin" : " is another")));
        return turned.value_or(m);
    });
}

uint32_t material_of(const PlaneDescription& p, bool legacy, MaterialTable& materials)
{
    if (p.bands) return materials.banded(p.material, *p.bands, TextureType::grid, p.where);
    if (!p.is_water) return materials.named(p.material, p.where);
    TextureDescription waves;
    waves.where = p.where;
    waves.type = TextureType::waves;
    waves.waves = p.waves.empty() ? default_waves(legacy) : p.waves;
    const auto with_waves = [&](MaterialDescription m) {
        m.bump_map = waves;
        return m;
    };
    const std::string_view bytes(reinterpret_cast<const char*>(waves.waves.data()), waves.waves.size() * sizeof(Wave));
    const std::string how = "waves " + std::to_string(hash_bytes(bytes));
    return materials.changed(p.material, p.where, how, clear_water(), with_waves);
}

}  // namespace lancer
