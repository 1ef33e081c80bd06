// The scenes of which whole pictures are timed: the project's own, and the shared anchors that other renderers were
// measured on, where they are.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "harness/program.h"
#include "scene/description/description.h"

namespace lancer::bench {

struct BenchScene {
    std::string name;
    double aspect;           // of the picture, width over height
    RenderSettings picture;  // what overrides its scene file
    std::function<SceneDescription()> load;
    // Two independent pictures of it by another renderer, and the height that they have; empty if there are none.
    std::array<std::string, 2> references{};
    uint32_t reference_height = 0;

    // The options for a picture of this height.
    RenderSettings options(uint32_t height) const;
};

// All that the options want.
std::vector<BenchScene> choose_scenes(const Options& options);

}  // namespace lancer::bench
