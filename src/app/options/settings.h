// What is rendered and how: the command line over [render] of the scene over the defaults below.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/options/options.h"
#include "core/switches.h"
#include "render/renderer.h"
#include "scene/camera.h"

namespace lancer {

// Names as the command line and the scene file know them; the first is the default but for the filter and the ISA.
extern const std::vector<std::string_view> integrator_names, sampler_names, filter_names, accel_names, isa_names;

struct Settings {
    uint32_t width = 1280, height = 720;
    Tile crop{};  // the part to render
    uint32_t spp = 64;
    uint64_t seed = 0;
    uint32_t max_depth = 0;
    double stop_error = 0.01;
    uint32_t replicates = 1;
    std::string integrator = "path", sampler = "sobol", filter = "blackman-harris", accel = "auto", isa = "avx2";
    Switches switches;
    PixelGrid grid = PixelGrid::centres;
    ToneMap tonemap = ToneMap::srgb;  // unless --tonemap says otherwise
    uint32_t threads = 1;
};

// Throws Error: invalid_input for what [render] says, usage for what only both together can tell.
// Where legacy is switched on the pixel grid, the filter and the tone map are those of the program that had such an
// integrator.
Settings resolve_settings(const PictureOptions& options, const RenderDescription& scene);

RenderSettings to_render_settings(const Settings& settings, uint32_t batch);

// The options that give the same samples again, whatever [render] says. Without spp, crop, threads.
std::string reproducing_options(const Settings& settings);

}  // namespace lancer
