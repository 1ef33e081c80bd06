// An independent integrator to judge the others by: double, a loop over all primitives, random walks that only surfaces
// steer. It shares the description of scenes with the program, and nothing that computes.
#pragma once

#include "reference/closest.h"

namespace reference {

struct Options {
    uint32_t width = 16, height = 12, spp = 64;
    uint32_t max_depth = 0;  // surface vertices that scatter, as of `path`; 0: no limit but Russian roulette
    uint64_t seed = 1;
    unsigned threads = 1;  // changes no number
    bool indirect = true;  // else as `direct`
};

// Rows from the top; filter: a box of one pixel.
struct Picture {
    uint32_t width = 0, height = 0, spp = 0;
    std::vector<Rgb> mean;
    std::vector<double> variance;  // of the mean of each pixel's luminance, by its samples

    const Rgb& at(uint32_t x, uint32_t y) const { return mean[size_t{y} * width + x]; }
};

// Throws std::invalid_argument for what it does not know, and where the description has no camera. images: for textures
// and environments, by name.
Picture render(const lancer::SceneDescription& scene, const Options& options, const lancer::RasterSource& images = {});
Picture render(const World& world, const lancer::CameraDescription& camera, const Options& options);

// Of the description's camera through a place of the film, x to the right and y down, in pixels; lens: in [0, 1) each.
Ray camera_ray(const lancer::CameraDescription& camera, double x, double y, uint32_t width, uint32_t height,
               double lens_u = 0, double lens_v = 0);

}  // namespace reference
