// The settings of a render: the command line over [render] of the scene over the defaults, which --legacy changes.
#pragma once

#include <string>

#include "io/image/tonemap.h"
#include "scene/camera.h"
#include "scene/description/exposure.h"
#include "scene/description/render_settings.h"

namespace lancer {

// Every option has its value then: max_depth is that of the integrator where none is given, the filter and the stop of
// pixels are those of the older program where legacy is on and they are not given. Throws Error (usage) where this
// build lacks what is asked for.
RenderSettings resolve_settings(const RenderSettings& command_line, const RenderSettings& scene);

// Throws Error (usage) where the denoiser has no use: it needs two samples per pixel, of path or direct.
void require_denoisable(const RenderSettings& settings);
// Throws Error (usage) for integrators whose light cannot be divided into layers.
void require_layers(const RenderSettings& settings);

// What else depends on the settings: where pixels lie, and the tone map unless --tonemap gives another.
PixelGrid pixel_grid(const RenderSettings& settings);
ToneMap usual_tonemap(const RenderSettings& settings);
// The exposure where none is given: chosen from the picture of a bare mesh, none of a scene file and with legacy.
Exposure usual_exposure(const std::string& scene_file, const RenderSettings& settings);

// The options that give the same samples again, whatever [render] of the scene gives. Without spp.
std::string reproducing_options(const RenderSettings& settings);

// Of all that decides the value of a pixel, but the scene; settings: resolved, camera: its name and how the command
// line changes it.
std::string settings_hash(RenderSettings settings, const std::string& camera);

}  // namespace lancer
