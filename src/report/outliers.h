// Where the error of a picture comes from: its samples with the largest residuals, and its variance by class of path.
// Nothing is kept for it while a picture is rendered: the samples of a few pixels are traced again, with their bits.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/counters.h"

namespace lancer {

class Camera;
class Renderer;
struct Film;

struct Outlier {
    SampleId id;
    double luminance = 0, mean = 0;  // of the sample; of its pixel
    double share = 0;                // of the error of the picture, 0..1
    std::string light;               // class of path that brings most of it
    std::string material;            // that the camera ray hits; empty: none
};

// A part of the error; parts of a kind sum to 1.
struct ErrorShare {
    std::string name;
    double share = 0;
};

struct ErrorSources {
    std::vector<Outlier> outliers;  // the largest first
    // No other sample has more than this share: that of the last outlier, or more if the search ended early.
    double others_at_most = 0;
    // By class of path, "indirect, sky, light sampling" for example: the covariance of its light with the sample. By
    // the material that the camera ray hits. Both from the samples of some pixels, chosen by their error; the largest
    // first.
    std::vector<ErrorShare> classes, materials;
};

// The error is that of estimate_rel_mse(). film: complete passes of this renderer and camera, all samples from 0 on.
// count: number of outliers, >= 1. Nothing where no pixel has an error. Must be called inside with_threads.
ErrorSources find_error_sources(const Renderer& renderer, const Camera& camera, const Film& film, size_t count);

}  // namespace lancer
