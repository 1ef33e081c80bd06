// Error against stiffness: what becomes of an error as one parameter goes to its extreme, of the product and of the
// formula that one would write first. Sweeps are drawn on the matrix's page, on logarithmic axes; rows judge.
#pragma once

#include <string>
#include <vector>

namespace lancer::stability {

struct SweepPoint {
    double x = 0, error = 0;  // an error of 0 or that is not finite is left out of the plot, which says so
};
struct SweepCurve {
    std::string name;  // "lancer", "naive float formula"
    std::vector<SweepPoint> points;
};
struct Sweep {
    std::string title, x, y;  // what is swept; the axes' labels, with units
    std::vector<SweepCurve> curves;
};

// Each in a file of its own, sweeps_NAME.cpp; each takes seconds at most.
std::vector<Sweep> scale_sweeps();
std::vector<Sweep> sphere_sweeps();
std::vector<Sweep> surface_sweeps();
std::vector<Sweep> light_sweeps();
std::vector<Sweep> film_sweeps();
std::vector<Sweep> all_sweeps();

}  // namespace lancer::stability
