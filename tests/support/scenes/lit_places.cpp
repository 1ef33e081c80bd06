#include "support/scenes/lit_places.h"

namespace lancer {

std::vector<SceneDescription> hidden_lights()
{
    SceneDescription wall;
    wall.materials = {make_lambert("wall", {0.8f, 0.8f, 0.8f}), make_emitter("lamp", {5, 5, 5})};
    wall.materials[1].emission_both_sides = true;
    wall.planes.push_back(plane_of({0, 0, 0}, {0, 0, 1}, "wall"));
    wall.spheres.push_back(sphere_of({0.5, 0.1, 0.6}, 0.5, "wall"));
    wall.lights = {light_of(LightType::point, {9, 9, 9}, {-0.5, 0.2, -1e-4}),
                   light_of(LightType::sphere, {9, 9, 9}, {0.3, 0, -0.2 - 1e-4}, 0.2)};
    wall.meshes.push_back(triangle_mesh({-1, -1, -1e-4}, {1, -1, -1e-4}, {0, 1, -0.5}, wall.materials[1]));
    wall.camera = make_camera({0.2, 0.3, 3}, {0, 0, 0}, 50);

    SceneDescription boxes;
    boxes.materials = wall.materials;
    // A floor that ends: from 100 away float does not tell a distance from one 1e-4 longer.
    boxes.meshes.push_back(make_mesh(make_quad({-9, -1, 9}, {9, -1, 9}, {9, -1, -9}, {-9, -1, -9})));
    boxes.spheres.push_back(sphere_of({1.2, 0, 0}, 0.8, "wall"));
    boxes.meshes.push_back(
        make_mesh(make_cube(make_lambert("box", {0.8f, 0.8f, 0.8f})), {{-1, 0, 0}, {10, 20, 30}, {0.7, 0.7, 0.7}}));
    boxes.lights = {light_of(LightType::point, {9, 9, 9}, {1.2, 0.8 - 1e-4, 0}),
                    light_of(LightType::sphere, {9, 9, 9}, {1.2, 0, 0}, 0.8 - 1e-4),
                    light_of(LightType::sphere, {9, 9, 9}, {-1, 0, 0}, 0.69)};
    boxes.camera = make_camera({0.2, 0.3, 5}, {0, 0, 0}, 50);
    return {wall, boxes};
}

stats::Tally irradiance(const Scene& scene, const Surface& from, int side, Random& random)
{
    stats::Tally sum;
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
            const auto jitter = [&](int k) {
                return std::min(1 - 0x1p-24f, (static_cast<float>(k) + random.unit()) / static_cast<float>(side));
            };
            const float u = jitter(i);
            const auto s = sample_light(scene, from, random.unit(), {u, jitter(j)});
            sum.add(s ? static_cast<double>(s->radiance.r * std::max(0.0f, dot(s->wi, from.n)) / s->pdf) : 0);
        }
    return sum;
}

Scene sphere_at(double distance, double radius)
{
    SceneDescription d;
    d.lights.push_back(light_of(LightType::sphere, {2, 2, 2}, {0, distance, 0}, radius));
    d.spheres.push_back(sphere_of({0, 0, 0}, distance / 1024));
    return build_scene(d);
}

}  // namespace lancer
