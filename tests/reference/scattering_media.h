// Media that scatter, by another method than the program's: spectral tracking with null collisions, Kutz, Habel, Li,
// Novak, "Spectral and Decomposition Tracking for Rendering Heterogeneous Volumes", SIGGRAPH 2017.
#pragma once

#include "reference/closest.h"
#include "reference/media.h"
#include "reference/random.h"

namespace reference {

// What a ray runs through, from one distance to another.
struct Within {
    Rgb scattering, absorption;
    double g = 0;
    double from = 0, to = 0;
};
// Of a ray of length t that starts in `in`: of a body, else of the fog.
Within along(const World& world, const Inside& in, const Ray& ray, double t);

// Part of the light that goes on straight.
Rgb transmittance(const Within& w);

// Runs through it. Returns the distance at which the ray is scattered, or nothing if it comes through; throughput: what
// it carries.
std::optional<double> track(const Within& w, Rgb& throughput, Random& random);

// Density of a deflection by that cosine, per solid angle, and a direction that is drawn by it.
double henyey_greenstein(double g, double cosine);
Vec deflected(double g, Vec direction, Random& random);

}  // namespace reference
