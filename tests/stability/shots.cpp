#include "stability/shots.h"

namespace lancer::stability {

Film shoot(const SceneDescription& d, const Shot& shot, const Setup& setup, Outcome& out)
{
    RenderRequest r = request_of(shot);
    r.threads = setup.tier == Tier::A ? 1 : available_threads();
    r.images = shot.images;
    return counted_render(d, r, out);
}

double worst_pixel(const Film& film, Color expected)
{
    double worst = 0;
    for (const Pixel& p : film.pixels)
        for (size_t c = 0; c < 3; ++c) {
            const double e = c == 0 ? double{expected.r} : c == 1 ? double{expected.g} : double{expected.b};
            worst = std::max(worst, std::abs(p.sum[c] / p.n - e) / e);
        }
    return worst;
}

double all_light(const Film& film)
{
    double sum = 0;
    for (const Pixel& p : film.pixels) sum += p.sum[0] + p.sum[1] + p.sum[2];
    return sum;
}

std::vector<Tile8> tiles_of(const Film& film)
{
    std::vector<Tile8> tiles(size_t{film.width / 8} * (film.height / 8));
    for (uint32_t y = 0; y < film.height; ++y)
        for (uint32_t x = 0; x < film.width; ++x) {
            const stats::Tally t = tally(film.at(x, y));
            Tile8& tile = tiles[size_t{y / 8} * (film.width / 8) + x / 8];
            tile.mean += t.mean / 64, tile.variance += t.variance() / t.n / (64.0 * 64);
        }
    return tiles;
}

}  // namespace lancer::stability
