// Scenes that lack everything, and how a thing comes into them where no ray meets it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/stage.h"

namespace lancer::bench {

struct Base {
    std::string name;
    SceneDescription description;
};

// A closed room of one material with a panel of light below its ceiling, seen from within. triangles: 0 for its walls
// alone.
Base make_base(const std::string& name, uint64_t triangles);

struct Feature {
    std::string name;
    std::function<void(SceneDescription&, RenderSettings&, Film&)> bring;  // called for a film of no pixels, too
};

std::vector<Feature> features();

}  // namespace lancer::bench
