// A description to a film in one call.
#pragma once

#include "core/parallel.h"
#include "render/aov.h"
#include "render/renderer.h"
#include "support/scenes.h"

namespace lancer {

// Every integrator, with its defaults.
inline std::vector<AnyIntegrator> all_integrators()
{
    std::vector<AnyIntegrator> all;
    for (const std::string_view name : names_of_integrators()) all.push_back(make_integrator(name, {}));
    return all;
}

struct RenderRequest {
    uint32_t width = 32, height = 24;
    std::optional<Tile> crop;       // default: the whole picture
    std::vector<uint32_t> spp{16};  // samples of each pass, one after the other
    unsigned threads = 1;
    uint32_t tile = 16;
    std::vector<Aov> aovs{};
    RenderSettings settings{};
    RasterSource images = test_picture;
};

struct Rendered {
    Film film;
    Counters counters;
};

inline Rendered render(const SceneDescription& d, const RenderRequest& r)
{
    Rendered out{Film(r.width, r.height, r.crop.value_or(Tile{0, 0, r.width, r.height})), {}};
    out.film.keep_aovs(layout_of(r.aovs));
    if (r.settings.kernel.stop != StopRule::never) out.film.wanted.resize(out.film.pixels.size());
    with_threads(r.threads, [&] {
        const Renderer renderer(build_scene(d, r.images), r.settings);
        const Camera camera = camera_of(d, renderer.scene(), r.width, r.height);
        const std::vector<Tile> tiles = make_tiles(out.film.crop, r.tile);
        uint32_t begin = 0;
        for (const uint32_t n : r.spp) {
            out.counters += renderer.pass(camera, out.film, tiles, {begin, begin + n}).counters;
            begin += n;
        }
    });
    return out;
}

}  // namespace lancer
