// Non-local means: each pixel becomes the mean of those in a window whose patches are alike.
#pragma once

#include <span>
#include <vector>

#include "render/denoise/patch_distance.h"

namespace lancer::denoise {

struct NonLocalMeans {
    int patch_radius = 3, window_radius = 5;  // pixels; together at most Plane::margin
    float k = 1;                              // how unlike patches may be: differences count in units of k
};

// The planes filtered, with mirrored margins.
std::vector<Plane> non_local_means(std::span<const Plane> planes, const Guide& guide, const NonLocalMeans& settings);

// Filters each half's features, guided by the other half's.
void filter_features(struct Halves& halves);

}  // namespace lancer::denoise
