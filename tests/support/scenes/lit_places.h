// Light as scenes have it for which there are closed forms: lights that are hidden, a light seen from a place,
// polygons.
#pragma once

#include <array>

#include "scene/lights/light.h"
#include "support/random.h"
#include "support/stage.h"
#include "support/statistics/significance.h"

namespace lancer {

// Lights behind a wall, or in a closed box or ball, 1e-4 from its surface: not a trace on this side.
std::vector<SceneDescription> hidden_lights();

// Irradiance at a place by light sampling, without occlusion: the mean over a jittered grid.
stats::Tally irradiance(const Scene& scene, const Surface& from, int side, Random& random);

// A sphere of radiance 2 straight above the origin, which stays in the scene's frame.
Scene sphere_at(double distance, double radius);

// Lambert's formula: E = L / 2 times the sum over the edges of their angle seen from the place, times the cosine
// between the normal and that of the plane through the edge.
template <size_t corners>
double lambert(Vec3d p, Vec3d n, std::array<Vec3d, corners> corner)
{
    double sum = 0;
    for (Vec3d& c : corner) c = normalize(c - p);
    for (size_t i = 0; i < corners; ++i) {
        const Vec3d a = corner[i], b = corner[(i + 1) % corners], x = cross(a, b);
        sum += std::atan2(length(x), dot(a, b)) * dot(normalize(x), n);
    }
    return 0.5 * std::abs(sum);
}

}  // namespace lancer
