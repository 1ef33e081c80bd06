// What every command that traces rays does first: load, complete, build, settle. Warnings are printed on the way.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/options/options.h"
#include "app/options/settings.h"
#include "io/image/source.h"
#include "render/renderer.h"

namespace lancer {

struct Prepared {
    RenderSettings settings;  // resolved
    unsigned threads = 1;
    SceneDescription description;         // with a camera
    std::unique_ptr<ImageSource> images;  // reads the pictures of the scene beside everything else
    std::vector<RasterFuture> early;      // those that mesh files name, asked for before the scene does
    std::optional<SceneBuilder> scene;    // until make_renderer() takes it
    std::vector<std::string> warnings;
};

// In parts, so that each can be timed. quiet: what was added to the scene is not said.
Prepared load_prepared(const PictureOptions& options, Diagnostics& diagnostics, bool quiet);
// Everything but the pictures, which are read from here on.
void begin_prepared(Prepared& prepared, Diagnostics& diagnostics);
// Builds the accelerator, waits for the pictures, and says what was wrong. Throws Error (invalid_input) if there were
// warnings and none are allowed. Call inside with_threads.
std::unique_ptr<Renderer> make_renderer(Prepared& prepared, const PictureOptions& options, uint32_t batch,
                                        Diagnostics& diagnostics);

}  // namespace lancer
