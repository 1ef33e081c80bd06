#include "support/scenes/media_scenes.h"

namespace lancer {

MaterialDescription make_medium(std::string name, float ior, Color absorption, std::optional<int32_t> priority)
{
    MaterialDescription m = make_lambert(std::move(name), {1, 1, 1});
    m.type = MaterialType::glass;
    m.ior = ior;
    m.absorption = absorption;
    m.priority = priority;
    return m;
}

// A glass ball and one of something denser, both half in a block of tinted water that they overlap, a frosted one and a
// bubble in the water, a hollow ball without priorities, a matt ball and a lamp under water.
SceneDescription media_scene()
{
    SceneDescription d;
    d.materials = {make_medium("water", 1.33f, {1, 0.4f, 0.2f}, 1),
                   make_medium("ball", 1.5f, {0.2f, 0.1f, 0.6f}, 3),
                   make_medium("gem", 2.1f, {0.5f, 2, 0.5f}, 2),
                   make_medium("air", 1, {}, 4),
                   make_medium("frosted", 1.6f, {0.3f, 0.3f, 0.3f}, 5),
                   make_medium("shell", 1.5f, {}),
                   make_medium("hollow", 1 / 1.5f, {}),
                   make_lambert("matt", {0.8f, 0.7f, 0.3f}),
                   make_lambert("floor", {0.6f, 0.6f, 0.6f})};
    d.materials[4].roughness = 0.4f;
    d.planes.push_back(plane_of({0, -0.8, 0}, {0, 1, 0}, "floor"));
    // The block ends below the floor.
    d.meshes.push_back(make_mesh(make_cube(), {{0, -0.5, 0}, {0, 20, 0}, {1.3, 0.5, 0.7}}));
    d.meshes.back().material = "water";
    d.spheres = {sphere_of({-0.6, 0, 0.2}, 0.35, "ball"),     sphere_of({-0.3, 0.05, 0.1}, 0.25, "gem"),
                 sphere_of({0.1, -0.3, 0.4}, 0.15, "air"),    sphere_of({0.5, -0.1, 0.3}, 0.25, "frosted"),
                 sphere_of({0.9, 0.4, 0}, 0.3, "shell"),      sphere_of({0.9, 0.4, 0}, 0.26, "hollow"),
                 sphere_of({0.15, -0.5, -0.2}, 0.25, "matt"), sphere_of({-0.55, 0.05, 0.25}, 0.1, "air")};
    d.lights.push_back(light_of(LightType::sphere, {6, 6, 6}, {0.75, -0.4, -0.1}, 0.1));
    d.lights.push_back(light_of(LightType::sphere, {9, 9, 8}, {-0.8, 2, 1}, 0.4));
    d.lights.push_back(sky_of({0.3f, 0.35f, 0.4f}));
    d.camera = make_camera({0.3, 0.9, 3.6}, {0, -0.1, 0}, 38);
    return d;
}

MaterialDescription make_scattering(std::string name, float ior, Color scattering, Color absorption, float anisotropy)
{
    MaterialDescription m = make_medium(std::move(name), ior, absorption);
    m.scattering = scattering;
    m.scattering_anisotropy = anisotropy;
    return m;
}

FogDescription fog_of(Color scattering, Color absorption, float anisotropy)
{
    FogDescription fog;
    fog.scattering = scattering, fog.absorption = absorption, fog.anisotropy = anisotropy;
    return fog;
}

// A ball of cloud, whose border is nothing, one of milk in smooth glass, one of wax with a rough surface, and one of
// absorbing gas before them; on a floor, under a large lamp and a sky.
SceneDescription scattering_scene()
{
    SceneDescription d;
    MaterialDescription wax = make_medium("wax", 1.4f, {});
    wax.roughness = 0.5f;
    wax.subsurface_color = Color{0.8f, 0.5f, 0.3f};
    wax.subsurface_radius = {0.2f, 0.1f, 0.05f};
    d.materials = {make_scattering("cloud", 1, {2, 3, 4}, {0.5f, 0.2f, 0.1f}, 0.5f),
                   make_scattering("milk", 1.3f, {6, 5, 4}, {0.1f, 0.2f, 0.4f}, -0.3f), wax,
                   make_medium("gas", 1, {0.3f, 1, 2}), make_lambert("floor", {0.6f, 0.5f, 0.4f})};
    d.planes.push_back(plane_of({0, -0.5, 0}, {0, 1, 0}, "floor"));
    d.spheres = {sphere_of({-0.9, 0, 0}, 0.45, "cloud"), sphere_of({0.1, -0.05, 0}, 0.4, "milk"),
                 sphere_of({0.6, 0.1, 1}, 0.25, "gas")};
    d.meshes.push_back(make_mesh(make_cube(), {{1, -0.1, 0}, {10, 35, 0}, {0.35, 0.35, 0.35}}));
    d.meshes.back().material = "wax";
    d.lights = {light_of(LightType::sphere, {4, 4, 3.5f}, {0.4, 2, 1}, 0.7), sky_of({0.4f, 0.5f, 0.6f})};
    d.camera = make_camera({0.2, 0.7, 3.8}, {0.05, 0, 0}, 32);
    return d;
}

// Fog over a floor, between balls: one matt, one of glass, in which is none, one of thin glass, and a hole in the fog
// with a border of its own.
SceneDescription fog_scene()
{
    SceneDescription d;
    MaterialDescription sheet = make_glossy("sheet", MaterialType::glass, {0.9f, 1, 0.9f}, 0);
    sheet.thin = true;
    d.materials = {make_lambert("matt", {0.7f, 0.4f, 0.3f}), make_glossy("glass", MaterialType::glass, {1, 1, 1}, 0),
                   sheet, make_medium("gas", 1, {0.2f, 0.1f, 0.4f}), make_lambert("floor", {0.5f, 0.6f, 0.6f})};
    d.planes.push_back(plane_of({0, -0.5, 0}, {0, 1, 0}, "floor"));
    d.spheres = {sphere_of({-0.9, -0.1, 0}, 0.4, "matt"), sphere_of({0, -0.1, 0.3}, 0.4, "glass"),
                 sphere_of({0.9, 0, 0}, 0.4, "sheet"), sphere_of({0.4, 0.5, -0.6}, 0.4, "gas")};
    d.fog = fog_of({0.25f, 0.3f, 0.4f}, {0.05f, 0.05f, 0.02f}, 0.4f);
    d.fog->low = Vec3d{-3, -1, -3}, d.fog->high = Vec3d{3, 1.4, 3};
    d.lights = {light_of(LightType::sphere, {5, 5, 5}, {-0.3, 1.5, 0.6}, 0.5), sky_of({0.3f, 0.35f, 0.4f})};
    d.camera = make_camera({0.2, 0.6, 4}, {0, 0.1, 0}, 34);
    return d;
}

// The same under lights that no ray meets, one of them close to what the camera sees.
SceneDescription fog_between_points()
{
    SceneDescription d = fog_scene();
    d.lights = {light_of(LightType::point, {1, 1, 0.8f}, {-0.4, 0.5, 0.6}),
                light_of(LightType::point, {0.3f, 0.5f, 0.8f}, {0.5, 0.2, 1}),
                directional_of({0.5f, 0.5f, 0.4f}, {-0.4, -1, -0.3})};
    LightDescription spot = light_of(LightType::spot, {3, 2, 1.5f}, {1.2, 1.2, 0.9});
    spot.direction = {-0.6, -1, -0.3}, spot.inner_deg = 12, spot.outer_deg = 25;
    d.lights.push_back(spot);
    return d;
}

}  // namespace lancer
