#include "scene/wide_scene.h"

#include <algorithm>

#include "scene/surface.h"

namespace lancer {
namespace {

Row row(Vec3 v, float w = 0) { return {v.x, v.y, v.z, w}; }
Row row(Color c, float w = 0) { return {c.r, c.g, c.b, w}; }

bool is_plain(const Scene& scene, uint32_t material)
{
    return scene.emission[material].radiance.texture == no_texture && !scene.traits[material].has_holes();
}

WideScene::LightKind light_kind_of(const Scene& scene, const Light& light)
{
    using LightKind = WideScene::LightKind;
    if (const auto* triangle = std::get_if<TriangleLight>(&light)) {
        const uint32_t material = scene.shading[triangle->mesh].material_of(triangle->triangle);
        const bool fades = !scene.shading[triangle->mesh].alphas.empty();
        return triangle->area > 0 && !fades && is_plain(scene, material) ? LightKind::triangle : LightKind::other;
    }
    if (const auto* sphere = std::get_if<SphereLight>(&light))
        return scene.soft_shadows && is_plain(scene, scene.sphere_material[sphere->sphere]) ? LightKind::sphere
                                                                                            : LightKind::other;
    return std::holds_alternative<EnvironmentLight>(light) && !scene.environment_table ? LightKind::constant_environment
                                                                                       : LightKind::other;
}

RowTable<WideScene::light_rows>::Record light_of(const Scene& scene, uint32_t id)
{
    const auto& light = std::get<TriangleLight>(scene.lights.lights[id]);
    const Mesh& mesh = scene.geometry.meshes[light.mesh];
    const auto& corners = mesh.triangles[light.triangle];
    const Emission& emission = scene.emission[scene.shading[light.mesh].material_of(light.triangle)];
    const Vec3 a = mesh.positions[corners[0]], b = mesh.positions[corners[1]], c = mesh.positions[corners[2]];
    return {row(a, PointOnTriangle<float>::rounding(a, b, c)),
            row(b),
            row(c),
            row(light.n, light.area),
            row(emission.plain_towards(true), scene.lights.pick.probability(id)),
            row(emission.plain_towards(false))};
}

WideScene::SphereLightRow sphere_light_of(const Scene& scene, uint32_t id)
{
    const uint32_t sphere = std::get<SphereLight>(scene.lights.lights[id]).sphere;
    const Sphere& s = scene.geometry.spheres[sphere];
    return {{s.center.x, s.center.y, s.center.z, s.radius},
            row(scene.emission[scene.sphere_material[sphere]].plain_towards(true), scene.lights.pick.probability(id)),
            rounding_on(s)};
}

// Rows for all lights; those of other kinds are empty.
template <class T, class Of>
std::vector<T> rows_of(const std::vector<WideScene::LightKind>& light_kinds, WideScene::LightKind which, const Of& of)
{
    std::vector<T> rows;
    if (std::find(light_kinds.begin(), light_kinds.end(), which) == light_kinds.end()) return rows;
    rows.resize(light_kinds.size());
    for (uint32_t id = 0; id < light_kinds.size(); ++id)
        if (light_kinds[id] == which) rows[id] = of(id);
    return rows;
}

// Whether points of a material differ by their tangents alone.
bool only_turns(const Scene& scene, size_t material)
{
    const auto* principled = std::get_if<Principled>(&scene.materials[material]);
    if (!principled || !scene.traits[material].has_tangent || principled->transmission.value > 0) return false;
    bool has_texture = false;
    for_each_textured_parameter(*principled, [&](const auto& p) { has_texture |= p.texture != no_texture; });
    return !has_texture;
}

WideScene::Fixed fixed_of(const Scene& scene, size_t material)
{
    const bool turns = only_turns(scene, material);
    const MaterialTraits& traits = scene.traits[material];
    const bool is_mix = !scene.mix_of.empty() && scene.mix_of[material] != Scene::none;
    if ((traits.reads_uv && !turns) || traits.tilts() || is_mix) return {};
    WideScene::Fixed fixed{.is = !turns, .turns = turns};
    for (const bool front : {false, true}) {
        fixed.bsdf[front] =
            std::visit([&](const auto& m) { return AnyBsdf(m.at({.front = front})); }, scene.materials[material]);
        fixed.flags[front] = std::visit([](const auto& bsdf) { return bsdf_flags(bsdf); }, fixed.bsdf[front]);
    }
    return fixed;
}

}  // namespace

std::optional<WideScene> WideScene::of(const Scene& scene, Shading least)
{
    const Features needed = features_of(scene);
    const bool has_triangle_lights = needed.has(Feature::triangle_lights), has_sky = needed.has(Feature::constant_sky);
    if (!(plain | textured | any).covers(needed)) return {};
    WideScene d;
    std::vector<RowTable<1>::Record> albedo;
    d.shading = least;
    d.has_principled = needed.has(feature_of(MaterialType::principled));
    if (!plain.covers(needed) || (has_triangle_lights && has_sky)) d.shading = Shading::textured;
    if (!(plain | textured).covers(needed)) d.shading = Shading::any;
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        const auto* lambert = std::get_if<Lambert>(&scene.materials[i]);
        albedo.push_back({row(lambert ? lambert->albedo.value : Color{})});
        if (const auto* glass = std::get_if<Glass>(&scene.materials[i]))
            d.has_rough_glass = d.has_rough_glass || (!glass->thin && glass->roughness.value > 0);
        if (const auto* metal = std::get_if<Metal>(&scene.materials[i]))
            d.has_rough_metal = d.has_rough_metal || metal->roughness.value > 0;
        d.shines.push_back(!scene.emission[i].is_dark());
        if (d.shading == Shading::plain) continue;
        d.fixed.push_back(fixed_of(scene, i));
        d.triangle_flags.push_back(is_drawn | (scene.traits[i].tilts() ? 0 : is_straight) |
                                   (d.fixed[i].is ? is_fixed : 0) | (scene.traits[i].mirrors ? is_mirroring : 0));
    }
    d.albedo = RowTable<1>(std::move(albedo));
    if (d.shading == Shading::plain) d.flat = FlatTable::of(scene);
    for (const MeshShading& s : scene.shading) d.has_colors |= !s.colors.empty();
    for (const lancer::Light& light : scene.lights.lights) d.light_kinds.push_back(light_kind_of(scene, light));
    d.lights = RowTable<light_rows>(rows_of<RowTable<light_rows>::Record>(
        d.light_kinds, LightKind::triangle, [&](uint32_t id) { return light_of(scene, id); }));
    d.sphere_lights = rows_of<SphereLightRow>(d.light_kinds, LightKind::sphere,
                                              [&](uint32_t id) { return sphere_light_of(scene, id); });
    d.has_triangles_only =
        std::all_of(d.light_kinds.begin(), d.light_kinds.end(), [](LightKind l) { return l == LightKind::triangle; });
    return d;
}

}  // namespace lancer
