// Common steps of commands that trace rays: load, complete, build, resolve settings. Warnings are printed.
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
    PictureMemory memory;                 // what pictures may take
    std::unique_ptr<ImageSource> images;  // reads the pictures of the scene beside everything else
    std::vector<RasterFuture> early;      // those that mesh files name, asked for before the scene does
    std::optional<SceneBuilder> scene;    // until make_renderer() takes it
    std::vector<std::string> warnings;
};

// In parts, so that each can be timed. quiet: does not report what was added to the scene.
Prepared load_prepared(const PictureOptions& options, Diagnostics& diagnostics, bool quiet);
// Loads everything but the pictures, which are read from here on.
void begin_prepared(Prepared& prepared, Diagnostics& diagnostics);
// Builds the accelerator, waits for the pictures and reports problems. Throws Error (invalid_input) if there were
// warnings and --strict is set. Must be called inside with_threads.
std::unique_ptr<Renderer> make_renderer(Prepared& prepared, const PictureOptions& options, uint32_t batch,
                                        Diagnostics& diagnostics);

}  // namespace lancer
