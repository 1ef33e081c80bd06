// What the reference is asked about: small scenes that together hold every material, light, shape and texture. Lights
// are large, so that walks which nothing steers towards them find them.
#pragma once

#include "scene/description/presets.h"
#include "support/scenes/scenes.h"

namespace lancer {

// A floor and a wall behind it, two units wide, under a panel as large.
inline SceneDescription stage_scene(Color sky = {0.9f, 0.95f, 1})
{
    SceneDescription d;
    d.meshes.push_back(make_mesh(
        make_quad({-2, -0.6, 2}, {2, -0.6, 2}, {2, -0.6, -1}, {-2, -0.6, -1}, make_lambert("", {0.6f, 0.5f, 0.4f}))));
    d.meshes.push_back(make_mesh(
        make_quad({-2, -0.6, -1}, {2, -0.6, -1}, {2, 1.5, -1}, {-2, 1.5, -1}, make_lambert("", {0.4f, 0.5f, 0.6f}))));
    d.meshes.push_back(make_mesh(
        make_quad({-1, 1.6, -0.8}, {1, 1.6, -0.8}, {1, 1.6, 1.2}, {-1, 1.6, 1.2}, make_emitter("", {2, 1.8f, 1.5f}))));
    d.lights.push_back(sky_of(sky));
    d.camera = make_camera({0.2, 0.6, 3.6}, {0.1, 0.05, 0}, 27);
    return d;
}
inline MaterialDescription of_type(MaterialDescription m, MaterialType type)
{
    m.type = type;
    return m;
}
// On the stage: two balls and a tilted box, of these three materials.
inline SceneDescription on_stage(MaterialDescription a, MaterialDescription b, MaterialDescription c)
{
    SceneDescription d = stage_scene();
    a.name = "a", b.name = "b", c.name = "c";
    d.materials = {a, b, c};
    d.spheres = {sphere_of({-0.85, -0.05, 0.1}, 0.5, "a"), sphere_of({0.15, -0.1, 0.6}, 0.45, "b")};
    d.meshes.push_back(make_mesh(make_cube(), {{1.0, -0.1, 0}, {20, 30, 10}, {0.35, 0.35, 0.35}}));
    d.meshes.back().material = "c";
    return d;
}

inline SceneDescription mirrors_scene()
{
    SceneDescription d =
        on_stage(make_glossy("", MaterialType::mirror, {0.9f, 0.8f, 0.7f}, 0), make_lambert("", {0.7f, 0.3f, 0.2f}),
                 make_glossy("", MaterialType::mirror, {0.5f, 0.7f, 0.9f}, 0));
    d.lights.push_back(light_of(LightType::sphere, {3, 3, 2}, {-1.2, 1.2, 1.4}, 0.5));
    d.camera->type = CameraType::thin_lens;
    d.camera->aperture = 0.15;
    d.camera->focus = 3.2;
    return d;
}
inline SceneDescription glass_scene(float roughness)
{
    MaterialDescription tinted = make_glossy("", MaterialType::glass, {0.9f, 1, 0.8f}, roughness);
    MaterialDescription dense = make_glossy("", MaterialType::glass, {1, 1, 1}, roughness);
    dense.ior = 2.2f;
    MaterialDescription thin = make_glossy("", MaterialType::glass, {1, 0.9f, 0.9f}, roughness);
    thin.ior = 0.8f;
    return on_stage(tinted, dense, thin);
}
// Sheets: two balls and a box of them, and a tilted pane before all.
inline SceneDescription sheets_scene(float roughness)
{
    MaterialDescription clear = make_glossy("", MaterialType::glass, {1, 1, 1}, roughness);
    MaterialDescription tinted = make_glossy("", MaterialType::glass, {0.6f, 0.9f, 0.7f}, roughness);
    MaterialDescription dense = make_glossy("", MaterialType::glass, {0.9f, 0.7f, 1}, roughness);
    tinted.ior = 2.2f, dense.ior = 1.8f;
    for (MaterialDescription* m : {&clear, &tinted, &dense}) m->thin = true;
    SceneDescription d = on_stage(clear, tinted, dense);
    d.meshes.push_back(make_mesh(make_quad({-1.2, -0.5, 1.2}, {0.9, -0.5, 1.4}, {0.9, 0.5, 1}, {-1.2, 0.5, 0.8})));
    d.meshes.back().material = "b";
    return d;
}
// Sheets that let light through diffusely: two balls and a box, a ball of it and of metal, and a leaf that is lit from
// behind. Of the box the two lobes together would make light; of the leaf both are patterned, it is partly transparent,
// and its normals are tilted.
inline SceneDescription translucent_scene()
{
    SceneDescription d = on_stage(make_translucent("", {0.1f, 0.3f, 0.6f}, {0.8f, 0.5f, 0.2f}),
                                  make_translucent("", {0, 0, 0}, {0.9f, 0.8f, 0.7f}),
                                  make_translucent("", {0.9f, 0.5f, 0.2f}, {0.4f, 0.6f, 0.6f}));
    MaterialDescription leaf = make_translucent("leaf", {0.6f, 0.7f, 0.5f}, {0.5f, 0.6f, 0.4f});
    leaf.base_color_map.emplace();
    leaf.base_color_map->type = TextureType::checker;
    leaf.base_color_map->even = {0.9f, 0.9f, 0.9f}, leaf.base_color_map->odd = {0.1f, 0.3f, 0.2f};
    leaf.base_color_map->use.scale = {3, 3};
    leaf.transmittance_map = leaf.base_color_map;
    leaf.transmittance_map->use.offset = {0.5f, 0.2f};
    leaf.bump_map.emplace();
    leaf.bump_map->type = TextureType::waves;
    leaf.bump_map->waves = {{0.05, 0.4, 2, 0.3}};
    leaf.opacity = 0.8f;
    MaterialDescription half = make_lambert("half", {});
    half.type = MaterialType::mix;
    half.first = "a", half.second = "steel", half.weight = 0.3f;
    d.materials.push_back(half);
    d.materials.push_back(make_glossy("steel", MaterialType::metal, {0.6f, 0.6f, 0.7f}, 0.5f));
    d.spheres.push_back(sphere_of({-0.3, 0.6, -0.3}, 0.3, "half"));
    d.meshes.push_back(
        make_mesh(make_mapped_quad({-0.5, 0.2, 1.4}, {0.6, 0.2, 1}, {0.6, 0.9, 0.8}, {-0.5, 0.9, 1.2}, {1, 1}, leaf)));
    d.lights.push_back(light_of(LightType::sphere, {4, 3, 2}, {-1, 1, -0.2}, 0.4));
    return d;
}
inline SceneDescription metal_scene()
{
    MaterialDescription polished = make_copper("", 0);
    return on_stage(make_copper("", 0.5f), make_glossy("", MaterialType::metal, {0.9f, 0.7f, 0.3f}, 0.8f), polished);
}
inline SceneDescription plastic_scene()
{
    MaterialDescription rough = make_glossy("", MaterialType::plastic, {0.6f, 0.3f, 0.2f}, 0.6f);
    rough.specular = {0.9f, 0.8f, 1};
    MaterialDescription coated = make_glossy("", MaterialType::plastic, {0.2f, 0.5f, 0.8f}, 0);
    coated.ior = 1.8f;
    MaterialDescription worn = make_glossy("", MaterialType::plastic, {0.8f, 0.7f, 0.3f}, 0.7f);
    worn.metallic = 0.4f;
    return on_stage(rough, coated, worn);
}
inline SceneDescription principled_scene()
{
    const auto principled = [](Color base, const auto& change) {
        MaterialDescription m = default_description(MaterialType::principled);
        m.base_color = base;
        change(m);
        return m;
    };
    SceneDescription d = on_stage(
        principled({0.8f, 0.5f, 0.2f},
                   [](auto& m) {
                       m.coat = 0.9f, m.coat_color = {0.9f, 0.6f, 0.5f}, m.metallic = 0.5f, m.roughness = 0.6f;
                       m.specular = {0.6f, 0.9f, 1};
                   }),
        principled({0.3f, 0.1f, 0.4f},
                   [](auto& m) {
                       m.fuzz = 0.8f, m.fuzz_color = {0.9f, 0.7f, 0.6f}, m.diffuse_roughness = 0.6f, m.roughness = 0.7f;
                   }),
        principled({0.4f, 0.6f, 0.3f}, [](auto& m) {
            m.coat = 0.7f, m.coat_roughness = 0.6f, m.roughness = 0.5f, m.specular_weight = 0.7f;
        }));
    d.materials.push_back(principled({0.9f, 0.7f, 0.4f}, [](auto& m) {
        m.name = "d", m.film = 0.8f, m.film_thickness = 420, m.film_ior = 1.8f, m.roughness = 0.6f, m.metallic = 0.3f;
    }));
    d.materials.push_back(principled({0.2f, 0.2f, 0.3f}, [](auto& m) {
        m.name = "e", m.film = 1, m.film_thickness = 300, m.roughness = 0, m.metallic = 0.6f;
    }));
    d.spheres.push_back(sphere_of({-0.2, 0.7, -0.4}, 0.35, "d"));
    d.spheres.push_back(sphere_of({0.9, 0.75, -0.4}, 0.3, "e"));
    return d;
}
inline SceneDescription interfaces_scene()
{
    MaterialDescription lacquer = make_lambert("", {0.5f, 0.1f, 0.1f});
    lacquer.type = MaterialType::interface;
    lacquer.phong.specular = {0.6f, 0.5f, 0.4f};
    lacquer.phong.shininess = 12;
    lacquer.phong.diffusion = 0.9f;
    lacquer.phong.reflexion = 0.3f;
    SceneDescription d = on_stage(lacquer, *find_preset("emerald"), *find_preset("glass"));
    d.spheres.push_back(sphere_of({-0.2, 0.7, -0.4}, 0.35, "ruby"));
    d.spheres.push_back(sphere_of({0.9, 0.75, -0.4}, 0.3, "bronze"));
    return d;
}
// Mixes of mixes, one by a checker; vertex colours; a checker on a plane with axes of its own and on a ball.
inline SceneDescription mixes_scene()
{
    MaterialDescription checked = make_lambert("", {});
    checked.type = MaterialType::mix;
    checked.first = "matt", checked.second = "steel";
    checked.weight_map.emplace();
    checked.weight_map->type = TextureType::checker;
    checked.weight_map->even = {0.9f, 0.9f, 0.9f}, checked.weight_map->odd = {0.2f, 0.2f, 0.2f};
    checked.weight_map->use.scale = {6, 6};
    MaterialDescription nested = make_lambert("", {});
    nested.type = MaterialType::mix;
    nested.first = "a", nested.second = "chrome", nested.weight = 0.3f;
    MaterialDescription tiles = make_lambert("", {1, 1, 1});
    tiles.base_color_map = checked.weight_map;
    tiles.base_color_map->even = {0.8f, 0.7f, 0.6f}, tiles.base_color_map->odd = {0.1f, 0.2f, 0.3f};
    SceneDescription d = on_stage(checked, nested, tiles);
    d.materials.push_back(make_lambert("matt", {0.2f, 0.6f, 0.3f}));
    d.materials.push_back(make_glossy("steel", MaterialType::metal, {0.6f, 0.6f, 0.7f}, 0.5f));
    d.materials.push_back(make_glossy("chrome", MaterialType::mirror, {0.9f, 0.9f, 0.9f}, 0));
    MeshData floor = *d.meshes[0].data;
    floor.colors = {{0.9f, 0.2f, 0.2f}, {0.2f, 0.9f, 0.2f}, {0.3f, 0.3f, 0.9f}, {0.8f, 0.8f, 0.8f}};
    d.meshes[0].data = std::make_shared<const MeshData>(floor);
    MaterialDescription wall = tiles;
    wall.name = "wall";
    d.materials.push_back(wall);
    PlaneDescription plane = plane_of({-0.3, 0.2, -0.9}, {0, 0, 1}, "wall");
    plane.axes = {Vec3d{1.3, 0.4, 0}, Vec3d{-0.2, 1.1, 0}};
    d.planes.push_back(plane);
    return d;
}
// Light that no ray meets.
inline SceneDescription points_scene()
{
    SceneDescription d =
        on_stage(make_lambert("", {0.7f, 0.6f, 0.3f}), make_glossy("", MaterialType::metal, {0.9f, 0.8f, 0.6f}, 0.7f),
                 make_glossy("", MaterialType::plastic, {0.3f, 0.4f, 0.7f}, 0.5f));
    d.meshes.erase(d.meshes.begin() + 2);
    d.lights = {light_of(LightType::point, {3, 2, 2}, {-1, 1.3, 1.5}),
                light_of(LightType::point, {1, 2, 3}, {1.5, 0.8, 1}), directional_of({1, 1, 0.8f}, {-0.3, -1, -0.5})};
    LightDescription spot = light_of(LightType::spot, {3, 2, 1.5f}, {0.5, 2.5, 1.5});
    spot.direction = {-0.3, -2, -1}, spot.inner_deg = 8, spot.outer_deg = 25;
    d.lights.push_back(spot);
    return d;
}
// A picture of the sky, turned, and one of one colour over it; a ball, a plane, nothing else.
inline SceneDescription sky_picture_scene()
{
    SceneDescription d;
    d.materials = {make_glossy("a", MaterialType::metal, {0.9f, 0.8f, 0.6f}, 0.5f),
                   make_lambert("b", {0.7f, 0.4f, 0.3f}), make_lambert("floor", {0.5f, 0.5f, 0.5f}),
                   make_glossy("c", MaterialType::mirror, {0.9f, 0.9f, 0.9f}, 0)};
    d.spheres = {sphere_of({-0.9, 0, 0}, 0.5, "a"), sphere_of({0.2, -0.1, 0.4}, 0.4, "b"),
                 sphere_of({1.1, 0.1, -0.2}, 0.5, "c")};
    d.planes.push_back(plane_of({0, -0.5, 0}, {0.05, 1, 0}, "floor"));
    d.lights = {sky_map_of({1.5f, 1.2f, 1}, {20, 130, -15}), sky_of({0.05f, 0.05f, 0.1f})};
    d.camera = make_camera({0.3, 0.7, 3.6}, {0.1, 0.1, 0}, 40);
    return d;
}
// A named sky over a coloured ground, z up, with discs for the lights that have no extent; a ball that lets see
// through.
inline SceneDescription background_scene()
{
    SceneDescription d;
    d.background.emplace();
    d.background->sky = SkyType::dawn;
    d.background->ground = GroundType::color;
    d.background->ground_color = {0.2f, 0.15f, 0.1f};
    d.background->z_up = true;
    d.background->strength = 1.5f;
    d.background->glow = true;
    d.materials = {make_lambert("a", {0.7f, 0.6f, 0.5f}), make_glossy("b", MaterialType::glass, {1, 1, 1}, 0),
                   make_glossy("c", MaterialType::mirror, {0.9f, 0.9f, 0.9f}, 0)};
    d.spheres = {sphere_of({-0.9, 0, 0}, 0.5, "a"), sphere_of({0.2, 0.4, 0}, 0.4, "b"),
                 sphere_of({1.1, -0.2, 0.1}, 0.5, "c")};
    d.lights = {directional_of({2, 1.8f, 1.5f}, {0.4, 1, -0.35}), light_of(LightType::point, {2, 2, 3}, {1, -3, 1.2})};
    d.camera = make_camera({0.3, 3.6, 0.5}, {0.1, 0, 0.1}, 45);
    d.camera->up = {0, 0, 1};
    return d;
}
// holes_scene() under larger lamps.
inline SceneDescription cut_out_scene()
{
    SceneDescription d = holes_scene();
    for (MeshDescription& m : d.meshes)
        if (m.name == "shell") m.data = make_uv_sphere(4, 6, 0.1, m.data->materials[0]);
    return d;
}
// Stretched, mirrored and turned; smooth by the normals of corners, some of them tilted.
inline SceneDescription smooth_instances_scene()
{
    SceneDescription d = stage_scene();
    MeshData ball = *make_uv_sphere(5, 7, 0.1, make_lambert("", {0.7f, 0.6f, 0.3f}));
    for (const Vec3d& p : ball.positions) ball.normals.push_back(to_float(normalize(p)));
    ball.normal_triangles = ball.triangles;
    ball.normal_triangles[3] = {MeshData::no_normal, MeshData::no_normal, MeshData::no_normal};
    MeshDescription mesh = make_mesh(std::make_shared<const MeshData>(ball), {{0.1, 0, 0}, {0, 20, 0}, {1, 1.1, 1}});
    mesh.name = "ball";
    d.meshes.push_back(mesh);
    d.instances = {instance_of("ball", {{-0.9, -0.05, 0.2}, {10, 0, 30}, {0.45, 0.5, 0.4}}),
                   instance_of("ball", {{0.15, -0.1, 0.5}, {30, 45, 60}, {-0.3, 0.5, 0.4}}),
                   instance_of("ball", {{1, 0, 0.1}, {90, 0, 0}, {0.4, -0.3, -0.5}})};
    return d;
}
// Light of every kind of surface, also from behind, patterned, and of a whole wall.
inline SceneDescription emitters_scene()
{
    SceneDescription d = stage_scene({});
    MaterialDescription banner = make_emitter("banner", {2, 3, 2});
    banner.emission_map = picture_of("colours", Encoding::srgb);
    banner.emission_both_sides = true;
    banner.base_color = {0.5f, 0.5f, 0.5f};
    d.meshes[2] = make_mesh(
        make_mapped_quad({-1.2, -0.4, 0.4}, {-0.2, -0.4, -0.4}, {-0.2, 0.9, -0.4}, {-1.2, 0.9, 0.4}, {1, 1}, banner));
    MaterialDescription globe = make_emitter("globe", {1.5f, 1.2f, 1});
    globe.emission_map.emplace();
    globe.emission_map->type = TextureType::checker;
    globe.emission_map->use.scale = {6, 4};
    MaterialDescription wall = make_emitter("wall", {0.4f, 0.5f, 0.7f});
    d.materials = {globe, wall, make_lambert("ball", {0.8f, 0.8f, 0.8f})};
    d.spheres = {sphere_of({0.8, 0.3, 0}, 0.5, "globe"), sphere_of({0.2, -0.35, 0.8}, 0.25, "ball")};
    d.planes.push_back(plane_of({0, 0, 3.8}, {0, 0, -1}, "wall"));
    return d;
}

}  // namespace lancer
