// Scenes that are traced eight paths at a time, between them with all that such scenes may have.
#pragma once

#include <string>

#include "support/scenes/classic.h"
#include "support/scenes/scenes.h"
#include "support/shoot.h"

namespace lancer {

// Smooth normals, coarse enough to face away from rays, over a floor.
SceneDescription smooth_scene();
// No normals but those of its triangles: about 2 * rows * columns.
SceneDescription flat_scene(uint32_t rows, uint32_t columns);
SceneDescription sky_scene();
// More lamps than are chosen by one number, and one of them hardly shines. From 33 on a tree chooses.
SceneDescription many_lamps(int count);

// What is looked up at places: a picture, heights, a map of normals, colours of vertices, holes - the lamp has some,
// too - and what of it one place has besides another.
SceneDescription looked_up_scene();
SceneDescription looked_up_under_sky();

// Lights of all kinds but plain triangles, on shapes of all kinds.
SceneDescription all_lights();
// Too many for one number to choose: a tree does, but for what is infinitely far away.
SceneDescription many_lights();
SceneDescription sun_and_sky();
SceneDescription lamp_and_sky();
SceneDescription mapped_sky();

// All materials, mixed and with holes, and more of them: a mirror, smooth glass, what classic ray tracers have.
SceneDescription all_materials();
// Light that matt surfaces do not sample, and others do.
SceneDescription materials_under_sky();
// Plain lamps, which matt surfaces sample eight at a time; and more of them.
SceneDescription materials_under_lamps(int count);
// What mirrors, with normals that would send light into it; and glass whose inner side is seen.
SceneDescription smooth_materials();
// Triangles that no map tilts, but of which something else is looked up: pictures, colours of vertices and a mix on
// what mirrors with normals of its own.
SceneDescription pictured_materials();
// Few lights, so that lanes which choose alike sample together: balls, a small one and one with a picture among them, a
// panel and a sky.
SceneDescription balls_of_light();
// The same with the sky left to BSDF sampling.
SceneDescription balls_beside_a_sky();
// One that hardly shines beside the others, and is chosen by a number of its own.
SceneDescription a_dim_ball_more();
// So many that a tree chooses, but whether it is the sky.
SceneDescription many_balls();
SceneDescription inside_a_ball();
SceneDescription points_of_light();
SceneDescription materials_and_many_lights();

struct WideCase {
    std::string name;
    SceneDescription scene;
};
std::vector<WideCase> wide_cases();

}  // namespace lancer
