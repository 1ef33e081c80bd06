#include "stability/pictures.h"

#include "support/shoot.h"

namespace lancer::stability {

Film take(const SceneDescription& d, const CountedShot& shot, Outcome& out)
{
    RenderRequest r = request_of(shot);
    r.threads = shot.threads;
    r.settings.isa = shot.isa;
    return counted_render(d, r, out);
}

double mean_luminance(const Film& film)
{
    double sum = 0;
    for (const Pixel& p : film.pixels) sum += luminance_of(p);
    return sum / static_cast<double>(film.pixels.size());
}

double relative_rmse(const Film& a, const Film& b)
{
    double squares = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        const double d = luminance_of(a.pixels[i]) - luminance_of(b.pixels[i]);
        squares += d * d;
    }
    return std::sqrt(squares / static_cast<double>(a.pixels.size())) / mean_luminance(a);
}

std::vector<stats::Tally> tiles_over_seeds(const SceneDescription& d, CountedShot shot, uint32_t pictures, Outcome& out)
{
    const uint32_t across = shot.width / 8;
    std::vector<stats::Tally> tiles(size_t{across} * (shot.height / 8) + 1);
    const uint64_t first = shot.seed * 1000003;
    shot.sampler = SamplerKind::independent;
    for (uint32_t k = 0; k < pictures; ++k) {
        shot.seed = first + k;
        const Film film = take(d, shot, out);
        std::vector<double> sum(tiles.size());
        for (uint32_t y = 0; y < shot.height; ++y)
            for (uint32_t x = 0; x < shot.width; ++x)
                sum[size_t{y / 8} * across + x / 8] += luminance_of(film.at(x, y)) / 64;
        for (size_t i = 0; i + 1 < tiles.size(); ++i) sum.back() += sum[i] / static_cast<double>(tiles.size() - 1);
        for (size_t i = 0; i < tiles.size(); ++i) tiles[i].add(sum[i]);
    }
    return tiles;
}

}  // namespace lancer::stability
