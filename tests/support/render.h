// A description to a film in one call.
#pragma once

#include "core/parallel.h"
#include "render/aov.h"
#include "render/renderer.h"
#include "support/scenes/scenes.h"

namespace lancer {

// Every integrator, with its defaults.
std::vector<AnyIntegrator> all_integrators();

struct RenderRequest {
    uint32_t width = 32, height = 24;
    std::optional<Tile> crop;       // default: the whole picture
    std::vector<uint32_t> spp{16};  // samples of each pass, one after the other
    unsigned threads = 1;
    uint32_t tile = 16;
    std::vector<Aov> aovs{};
    std::optional<SetDeal> sets{};  // for the denoiser
    RendererConfig settings{};
    RasterSource images = test_picture;
    bool traces_open_sky = false;  // also the camera rays that are left out where they meet nothing; one thread
};

struct Rendered {
    Film film;
    Counters counters;
};

Rendered render(const SceneDescription& d, const RenderRequest& r);
// The same of a scene that is built from d already, for tests that draw it in many ways.
Rendered render(const Scene& scene, const SceneDescription& d, const RenderRequest& r);

}  // namespace lancer
