// The scene of all_test_scenes() that is made of what scene/build/shapes.h makes.
#include "scene/build/shapes.h"
#include "support/scenes/scenes.h"

namespace lancer {

// What is made of other shapes: planes with axes, bands and waves, a bubble, a pyramid and a triangle.
SceneDescription shapes_scene()
{
    SceneDescription d;
    d.materials = {make_lambert("floor", {0.8f, 0.7f, 0.5f}), make_lambert("lines", {0.1f, 0.1f, 0.2f}),
                   make_glossy("wall", MaterialType::glass, {0.9f, 1, 1}, 0),
                   make_glossy("ruby", MaterialType::plastic, {0.7f, 0.1f, 0.1f}, 0.3f)};
    PlaneDescription floor = plane_of({0.1, -0.7, 0}, {0, 1, 0}, "floor");
    floor.axes = {Vec3d{0.5, 0, 0}, Vec3d{0, 0, -0.4}};
    floor.bands = Bands{"lines", 0.1f};
    PlaneDescription water = plane_of({0, -0.4, 0}, {0, 1, 0});
    water.axes = {Vec3d{1, 0, 0}, Vec3d{0, 0, -1}};
    water.is_water = true;
    water.waves = {{0.01, 0.3, 0.4, 0}, {0.004, 1.9, 0.15, 1}};
    d.planes = {floor, water};
    for (const auto part : {SphereDescription::Part::bubble, SphereDescription::Part::inside_of_bubble}) {
        const bool inside = part == SphereDescription::Part::inside_of_bubble;
        d.spheres.push_back(sphere_of({-0.7, 0.2, 0.3}, inside ? 0.48 : 0.5, "wall"));
        d.spheres.back().part = part;
    }
    MeshDescription pyramid = make_mesh(make_pyramid({0.8, -0.5, -0.2}, 1, {0.1, 1, 0}));
    pyramid.material = "ruby";
    pyramid.bands = Bands{"lines", 0.04f};
    d.meshes.push_back(std::move(pyramid));
    MeshDescription triangle = make_mesh(make_triangle({-0.4, 1.1, -0.5}, {0.6, 1.1, -0.4}, {-0.4, 0.3, -0.5}));
    triangle.material = "floor";
    triangle.bands = Bands{"ruby", 0.1f};
    d.meshes.push_back(std::move(triangle));
    d.lights.push_back(light_of(LightType::sphere, {9, 9, 8}, {-0.5, 2.5, 1.5}, 0.4));
    d.lights.push_back(sky_of({0.3f, 0.35f, 0.4f}));
    d.camera = make_camera({0, 0.5, 4}, {0, 0.1, 0}, 40);
    return d;
}

}  // namespace lancer
