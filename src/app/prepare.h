// Common steps of commands that trace rays: load, complete, build, resolve settings. Warnings are printed.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/defaults/complete_scene.h"
#include "app/frame_cache.h"
#include "app/options/options.h"
#include "app/options/settings.h"
#include "io/image/source.h"
#include "render/renderer.h"

namespace lancer {

struct Prepared {
    RenderSettings settings;  // resolved
    unsigned threads = 1;
    SceneDescription description;         // with a camera
    CameraDescription metered;            // what --exposure auto looks at: of a turntable its first view
    Completed added;                      // what the scene did not say
    PictureMemory memory;                 // what pictures may take
    std::shared_ptr<ImageSource> images;  // reads the pictures of the scene beside everything else
    RasterSource pictures;                // asks it
    std::vector<RasterFuture> early;      // those that mesh files name, asked for before the scene does
    std::optional<SceneBuilder> scene;    // until make_renderer() takes it
    std::vector<std::string> warnings;
    uint32_t hidden_lights = 0;  // see scene/hidden_lights.h
    double hidden_lights_s = 0;  // seconds that looking for them took
};

// In parts, so that each can be timed. quiet: does not report what was added to the scene. film: of earlier frames, or
// null.
Prepared load_prepared(const PictureOptions& options, Diagnostics& diagnostics, bool quiet, FrameCache* film = nullptr);
// Loads everything but the pictures, which are read from here on.
void begin_prepared(Prepared& prepared, Diagnostics& diagnostics);
// Warns of lights that the renderer's integrator cannot find; returns how many there are. description: with a camera.
uint32_t warn_of_hidden_lights(const SceneDescription& description, const RenderSettings& settings,
                               const Renderer& renderer, Diagnostics& diagnostics);
// Builds the accelerator, calls accelerator_built, waits for the pictures and reports problems. before: whose
// accelerator is taken if its geometry is the same, or null. Throws Error (invalid_input) if there were warnings and
// --strict is set. Must be called inside with_threads.
std::unique_ptr<Renderer> make_renderer(Prepared& prepared, const PictureOptions& options, uint32_t batch,
                                        Diagnostics& diagnostics, const std::function<void()>& accelerator_built = {},
                                        const Renderer* before = nullptr);

// Whether the renderer that the film holds is of this very scene, seen from elsewhere at most.
bool is_same_scene(const FrameCache& film, const Prepared& prepared);
// In place of the two above for such a scene.
std::shared_ptr<const Renderer> renderer_of_film(const FrameCache& film, Prepared& prepared, Diagnostics& diagnostics);
// Leaves a renderer to the frames that follow.
void keep_for_film(FrameCache& film, const Prepared& prepared, std::shared_ptr<const Renderer> renderer);

}  // namespace lancer
