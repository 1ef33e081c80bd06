// What every command that traces rays does first: load, complete, build, settle. Warnings are printed on the way.
#pragma once

#include <string>
#include <vector>

#include "app/options.h"
#include "app/settings.h"
#include "render/renderer.h"

namespace lancer {

struct Prepared {
    Settings settings;
    SceneDescription description;  // with a camera
    Scene scene;
    std::vector<std::string> warnings;
};

// The two halves, so that each can be timed. quiet: what was added to the scene is not said.
Prepared load_prepared(const PictureOptions& options, Diagnostics& diagnostics, bool quiet);
void build_prepared(Prepared& prepared, const PictureOptions& options, Diagnostics& diagnostics);

}  // namespace lancer
