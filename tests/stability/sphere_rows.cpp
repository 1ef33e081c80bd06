// Rows P of the stability matrix: spheres and planes.
#include "stability/sphere_cases.h"

namespace lancer::stability {

std::vector<Row> sphere_rows()
{
    return {
        {"P1", "walls of spheres of radius 1e5, 1e6", "policy", Tier::A, false, wall_walk},
        {"P4", "shells of glass of thickness 1e-4 to 1e-6", "closed form", Tier::A, false, nested_shells},
        {"P6", "rays that graze spheres", "long double", Tier::A, false, tangent_rays},
        {"P7", "a plane of squares out to 1e7", "long double", Tier::A, false, grazing_checker},
        {"P8", "slopes of 0, denormal and 1e-8 at the horizon", "policy", Tier::A, false, horizon},
    };
}

}  // namespace lancer::stability
