// Rows P that follow rays, each with every accelerator that the product promises something for: Embree's fast mode as
// the benches drive it knows neither spheres nor planes.
#pragma once

#include "stability/row.h"

namespace lancer::stability {

// sphere_cases.cpp
Outcome wall_walk(const Setup& setup);
Outcome nested_shells(const Setup& setup);
Outcome tangent_rays(const Setup& setup);
// plane_cases.cpp
Outcome grazing_checker(const Setup& setup);
Outcome horizon(const Setup& setup);

// Rays straight through the middle of a glass shell of that thickness, and refracted.
struct ShellCount {
    double rays = 0, wrong_straight = 0, wrong_refracted = 0;  // other than four surfaces
    double worst_radiance = 0;                                 // relative error of what comes through
    double worst_radiance_inside = 0;                          // of rays not near the rim
};
ShellCount cross_shell(const std::string& accelerator, double thickness, size_t rays);

}  // namespace lancer::stability
