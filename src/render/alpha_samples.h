// What the samples of a batch bring to alpha, beside whether their camera rays hit something: the background behind
// smooth glass.
#pragma once

#include <vector>

#include "integrators/path_actions.h"

namespace lancer {

struct AlphaSample {
    double through = 0;  // transmittance up to the hidden background, as a luminance
};

class AlphaSamples {
public:
    void begin(size_t slots) { samples_.assign(slots, {}); }
    const AlphaSample& of(size_t slot) const { return samples_[slot]; }

    void add_background(const PathState& s) { samples_[s.slot].through += luminance_of(s.throughput); }

private:
    static double luminance_of(Color c) { return luminance(double{c.r}, double{c.g}, double{c.b}); }

    std::vector<AlphaSample> samples_;  // of each slot
};

}  // namespace lancer
