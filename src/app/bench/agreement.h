// Which of several answers to the same rays are right. Where all agree they are taken for right; where two differ the
// list of triangles decides, in double.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/bench/rays.h"
#include "geometry/embree/bare_embree.h"

namespace lancer {

// One way to ask something that answers rays.
struct RayMethod {
    std::string name, way;
    std::function<void(std::span<const Ray>, std::span<Hit>, Coherence)> closest;
    std::function<void(std::span<const Ray>, std::span<uint8_t>, Coherence)> any;  // may be empty
    bool refined = true;                                                           // else its hits are Embree's own
};
// Embree called directly, in packets of this many; what is asked must outlive the method.
RayMethod direct_method(std::string name, const BareEmbree& embree, Way way);
// An accelerator, ray by ray, and in batches as the kernel asks.
RayMethod single_method(std::string name, const Accelerator& accel);
RayMethod batch_method(std::string name, const Accelerator& accel);

// One for each ray: of a nearest hit which, refined; of an occlusion whether.
struct Answers {
    std::vector<Hit> hits;
    std::vector<uint8_t> occluded;
};
Answers answer(const RayMethod& method, const RaySet& set, const Geometry& geometry);

// Per 1e6 rays: how many of each contestant's answers are not the list's, nor equally far, and how many of these are
// hits that were not found. Where more rays are in dispute than the list can be asked about, figures are extrapolated
// from those that it was.
struct Disagreements {
    std::vector<double> per_million, missed_per_million;  // of each contestant
    size_t disputed = 0, asked = 0;
};
// most_tests: what the list may cost, in triangles times rays; the default takes a second or two of one thread.
Disagreements count_disagreements(const Geometry& geometry, const RaySet& set, const std::vector<Answers>& answers,
                                  double most_tests = 1e8);

// Triangles that a ray may meet: those of instances count each time.
uint64_t drawn_triangles(const Geometry& geometry);

}  // namespace lancer
