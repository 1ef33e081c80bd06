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

}  // namespace lancer
