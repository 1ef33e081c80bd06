// The rows G that follow rays through meshes that are hard to build trees over.
#pragma once

#include "stability/row.h"

namespace lancer::stability {

Outcome slivers(const Setup& setup);
Outcome coincident_triangles(const Setup& setup);
Outcome large_grid(const Setup& setup);
Outcome one_place(const Setup& setup);

// A mesh file with its materials, rendered by the program with 1, 3 and 8 threads: pixels that are not the same. Within
// one process only the first number of threads asked for counts.
double pixels_by_threads(const std::string& obj, const std::string& mtl, const std::string& accelerator);

// A bound of seconds is held where a run takes minutes; a test would only tell of the machine's other work.
inline Measure seconds(const Setup& setup, const std::string& what, double value, double most)
{
    return setup.tier == Tier::A ? told(what, value) : at_most(what, value, most);
}

}  // namespace lancer::stability
