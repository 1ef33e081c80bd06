#include "stability/sweep.h"

namespace lancer::stability {

std::vector<Sweep> all_sweeps()
{
    std::vector<Sweep> all;
    for (auto* group : {scale_sweeps, sphere_sweeps, surface_sweeps, light_sweeps, film_sweeps})
        for (Sweep& sweep : group()) all.push_back(std::move(sweep));
    return all;
}

}  // namespace lancer::stability
