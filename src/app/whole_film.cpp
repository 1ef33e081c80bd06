#include "app/whole_film.h"

#include <algorithm>
#include <atomic>

namespace lancer {

void keep_for_settings(const RenderSettings& s, Film& film)
{
    if (s.stop) film.wanted.resize(film.pixels.size());
    if (s.replicates > 1) film.replicates.resize(film.pixels.size() * s.replicates);
}

bool fill_film(const Renderer& renderer, const Camera& camera, Film& film, uint32_t spp, const std::stop_token& stop,
               const std::function<void(double)>& report)
{
    if (!renderer.plan(camera, film.width, film.height, stop)) return false;
    const auto tiles = make_tiles(film.crop, samples_per_block);
    for (uint32_t begin = 0; begin < spp; begin += samples_per_block) {
        const uint32_t end = std::min(begin + samples_per_block, spp);
        std::atomic<size_t> done{0};
        const auto tile_done = [&](const Tile&) {
            const double of_pass = static_cast<double>(++done) / static_cast<double>(tiles.size());
            report((begin + of_pass * (end - begin)) / spp);
        };
        if (!renderer.pass(camera, film, tiles, {begin, end}, stop, tile_done).is_complete()) return false;
    }
    return true;
}

}  // namespace lancer
