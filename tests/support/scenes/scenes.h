// Small scenes in code, as descriptions: what the tests of scene, integrators and render draw. Each is about one unit
// large, has its camera, and fits a picture of any size.
#pragma once

#include <span>

#include "scene/camera.h"
#include "scene/scene.h"
#include "support/images.h"
#include "support/scenes/things.h"

namespace lancer {

// The inside of a sphere that emits everywhere and reflects rho: its radiance is emitted (1 + rho + rho^2 + ...).
SceneDescription closed_furnace(float rho, Color emitted = {1, 1, 1});

// A box open to the front with coloured walls, two blocks and a quad light of two triangles: meshes only, all diffuse.
SceneDescription cornell_scene();

// A mirror, a glass and a diffuse sphere on a plane under a sphere light and a constant sky, through a thin lens:
// no mesh at all.
SceneDescription spheres_scene();

// Every kind of light (point, sphere, emitting triangles, sky) over a bumpy mesh and a floor of two triangles.
SceneDescription lights_scene();

// One bumpy mesh in five places - turned, stretched, mirrored - and an instanced lamp, on a plane.
SceneDescription instances_scene();

// Textures of every kind, on meshes, an instance, a sphere and a plane.
SceneDescription textured_scene();

// Cut-outs and fractional opacity on all that can have it: meshes with and without a texture, one with both solid and
// half-open faces, instances, spheres, a plane, and lights of which a part is missing.
SceneDescription holes_scene();

// Everything between mirror and matt: rough metal by colour and by index, rough glass as a ball and as a pane with a
// point of light behind it, plastic smooth and rough, mixes by a checker and by a map of what is metal, and bumps;
// under a ball, a textured panel and a map of the sky.
SceneDescription glossy_scene();

SceneDescription media_scene();   // in support/scenes/media_scenes.cpp
SceneDescription shapes_scene();  // in support/scenes/shapes_scene.cpp

// Laws hold for each of these. To list tests takes no scene: they are made where one is drawn.
struct TestScene {
    const char* name;
    SceneDescription (*make)();
};
std::span<const TestScene> test_scenes();
struct NamedScene {
    const char* name;
    SceneDescription description;
};
std::vector<NamedScene> all_test_scenes();

// The same scene s times as large, seen the same: lengths grow by s, intensities by s^2, radiances stay.
SceneDescription scaled_by(SceneDescription d, double s);

inline Scene build_scene(const SceneDescription& d, const RasterSource& images = test_picture)
{
    Diagnostics diagnostics;
    return Scene::build(d, d.render, diagnostics, images);
}

// The camera of the description, or the one fitted to what it shows.
Camera camera_of(const SceneDescription& d, const Scene& scene, uint32_t width, uint32_t height);

}  // namespace lancer
