#include "report/tune.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <numeric>
#include <random>
#include <span>

#include "render/config.h"
#include "render/renderer.h"
#include "report/estimator_switches.h"
#include "report/metrics/picture_pairs.h"

namespace lancer {
namespace {

constexpr uint32_t batch = 256, tile_side = 16, spp = samples_per_block;
constexpr uint32_t fewest_rounds = 6;  // with fewer, an interval of the median is wrong more often than once in twenty
constexpr uint64_t pixels_wanted = 160 * 120;

double cpu_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

// Tiles of the picture by chance, until they have enough pixels: edges are as rare in them as in the picture.
std::vector<Tile> choose_tiles(PictureSize size)
{
    std::vector<Tile> tiles = make_tiles({0, 0, size.width, size.height}, tile_side);
    std::mt19937_64 random(1);
    std::shuffle(tiles.begin(), tiles.end(), random);
    uint64_t pixels = 0;
    size_t count = 0;
    while (count < tiles.size() && pixels < pixels_wanted) {
        pixels += uint64_t{tiles[count].width()} * tiles[count].height();
        ++count;
    }
    tiles.erase(tiles.begin() + static_cast<ptrdiff_t>(count), tiles.end());
    return tiles;
}

// Pictures by one value of the switches.
class Contestant {
public:
    Contestant(const Renderer& base, const CameraDescription& camera, const TuneRequest& request,
               std::span<const Tile> tiles, RenderSettings settings, Estimator o)
        : option(o),
          base_(base),
          tiles_(tiles),
          settings_(std::move(settings)),
          camera_(camera, base.scene().normalisation, settings_.size.width, settings_.size.height, request.grid)
    {
    }

    Film draw(uint64_t seed, uint32_t samples)
    {
        settings_.seed = seed;
        const uint32_t width = settings_.size.width, height = settings_.size.height;
        const Renderer renderer(base_, configure(settings_, batch));
        Film film(width, height, {0, 0, width, height});
        const double begin = cpu_seconds();
        renderer.plan(camera_, width, height);
        const double planned = cpu_seconds();
        renderer.pass(camera_, film, tiles_, {0, samples});
        plan_s_ += planned - begin, render_s_ += cpu_seconds() - planned;
        return film;
    }
    void draw_pair(uint64_t seed)
    {
        plan_s_ = render_s_ = 0;
        std::vector<Color> first = pixel_means(draw(seed, spp));
        pairs.push_back({std::move(first), pixel_means(draw(seed + 1, spp))});
        const double drawn = static_cast<double>(pairs.back()[0].size()) * spp;
        const double wanted = double(settings_.size.width) * settings_.size.height * settings_.spp;
        seconds.push_back(0.5 * (plan_s_ + render_s_ * wanted / drawn));
    }

    Estimator option;  // null: the settings themselves
    std::vector<PicturePair> pairs;
    std::vector<double> seconds;  // of the whole picture, by each pair

private:
    const Renderer& base_;
    std::span<const Tile> tiles_;
    RenderSettings settings_;
    Camera camera_;
    double plan_s_ = 0, render_s_ = 0;
};

double mean_luminance(const PicturePair& pair)
{
    double sum = 0;
    for (const std::vector<Color>& picture : pair)
        for (const Color c : picture) sum += double{luminance(c)};
    return sum;
}

RatioInterval ratios(const std::vector<double>& of) { return {median(of), median_interval(of)}; }

}  // namespace

TuneResult tune(const Renderer& base, const CameraDescription& camera, const TuneRequest& request)
{
    const RenderSettings& settings = request.settings;
    std::vector<Contestant> contestants;
    const std::vector<Tile> tiles = choose_tiles(settings.size);
    contestants.emplace_back(base, camera, request, tiles, settings, nullptr);
    const Film usual = contestants[0].draw(settings.seed, 1);
    for (const Estimator estimator : estimators()) {
        if (request.is_stopped()) break;
        Contestant other(base, camera, request, tiles, switched_over(settings, estimator), estimator);
        if (differing_pixels(usual, other.draw(settings.seed, 1)) > 0) contestants.push_back(std::move(other));
    }

    TuneResult result{pixel_means(usual).size(), spp, 0, {}};
    if (contestants.size() == 1) return result;
    // By chance, as who runs after whom matters to caches.
    std::vector<size_t> order(contestants.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::mt19937_64 random(1);
    const auto begin = std::chrono::steady_clock::now();
    const auto is_over = [&] {
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
        return result.rounds >= fewest_rounds && passed.count() >= request.seconds;
    };
    while (!request.is_stopped() && !is_over()) {
        std::shuffle(order.begin(), order.end(), random);
        for (const size_t i : order)
            if (!request.is_stopped()) contestants[i].draw_pair(settings.seed + 1 + 2 * result.rounds);
        if (!request.is_stopped()) request.round_done(++result.rounds);
    }
    if (result.rounds == 0) return result;

    std::vector<const PicturePair*> all;
    for (Contestant& c : contestants) {
        // An interrupted round does not have all of them.
        c.pairs.erase(c.pairs.begin() + result.rounds, c.pairs.end()), c.seconds.resize(result.rounds);
        for (const PicturePair& pair : c.pairs) all.push_back(&pair);
    }
    const std::vector<Color> mean = mean_of(all);
    const auto errors_of = [&](const Contestant& c) {
        std::vector<double> errors;
        for (const PicturePair& pair : c.pairs) errors.push_back(error_of(pair, mean));
        return errors;
    };
    const std::vector<double> usual_errors = errors_of(contestants[0]);
    for (size_t i = 1; i < contestants.size(); ++i) {
        const Contestant& c = contestants[i];
        std::vector<double> mean_ratio, time, error = errors_of(c), both;
        for (uint32_t r = 0; r < result.rounds; ++r) {
            mean_ratio.push_back(mean_luminance(c.pairs[r]) / mean_luminance(contestants[0].pairs[r]));
            time.push_back(c.seconds[r] / contestants[0].seconds[r]);
            error[r] /= usual_errors[r];
            both.push_back(time[r] * error[r]);
        }
        result.rows.push_back(
            {c.option, !is_on(settings, c.option), ratios(mean_ratio), ratios(time), ratios(error), ratios(both)});
    }
    return result;
}

}  // namespace lancer
