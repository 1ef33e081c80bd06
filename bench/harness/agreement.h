// Which of several answers to the same rays are right. Where all agree they are taken for right; where two differ the
// list of triangles decides, in double.
#pragma once

#include <string>
#include <vector>

#include "geometry/accel.h"
#include "harness/record.h"

namespace lancer::bench {

// One for each ray: of a nearest hit which, refined; of an occlusion whether.
struct Answers {
    std::vector<Hit> hits;
    std::vector<uint8_t> occluded;
};

// Per 1e6 rays: how many of each contestant's answers are not the list's, nor equally far. Where more rays are in
// dispute than the list can be asked about in some seconds, the figure is extrapolated from those that it was.
struct Disagreements {
    std::vector<double> per_million;  // of each contestant
    size_t disputed = 0, asked = 0;
};
Disagreements count_disagreements(const Geometry& geometry, const RaySet& set, const std::vector<Answers>& answers);

}  // namespace lancer::bench
