#include "render/estimators/pilot.h"

#include <cmath>

#include "core/parallel.h"
#include "integrators/view.h"
#include "render/estimators/arrivals.h"
#include "render/estimators/stop_rule.h"

namespace lancer {
namespace {

constexpr uint32_t most_cells = 64;  // in a row or column
constexpr uint32_t least_cell = 8;   // pixels
constexpr uint32_t paths = 8;        // of each pixel that is looked at
constexpr uint32_t parts = 2;        // of each path, which share it up to where it splits
constexpr uint32_t most_split = 4;   // beyond, edges of shapes would want for samples before the light does
constexpr double dark = 0.1;         // parts of the mean below which errors count as if it were so bright
constexpr double packed = 0.4;       // time of a camera ray, which goes with its neighbours, by that of a bounce
constexpr double occlusion = 0.6;    // likewise of a shadow ray
constexpr double stratified = 0.12;  // what is left, about, of variance in the few dimensions of a camera ray; fitted
constexpr double unsorted = 1;       // likewise in which of very many lights is chosen, which has no smooth order

// Statistics of a pixel's samples, in double.
struct PixelStatistics {
    std::array<double, 3> mean{};
    double among_paths = 0, among_parts = 0;  // variance of the luminance: of whole paths, of the parts of one
};

PixelStatistics measure_pixel(std::span<const RadianceSum> samples)
{
    PixelStatistics pixel;
    double sum = 0, squares = 0;
    for (uint32_t i = 0; i < paths; ++i) {
        const Color a = samples[parts * i].color(), b = samples[parts * i + 1].color();
        const auto y = [](Color c) { return luminance(double{c.r}, double{c.g}, double{c.b}); };
        const double mean = 0.5 * (y(a) + y(b)), difference = y(a) - y(b);
        if (!is_finite(a) || !is_finite(b)) return {};
        pixel.mean[0] += 0.5 * (double{a.r} + double{b.r}) / paths;
        pixel.mean[1] += 0.5 * (double{a.g} + double{b.g}) / paths;
        pixel.mean[2] += 0.5 * (double{a.b} + double{b.b}) / paths;
        sum += mean, squares += mean * mean;
        pixel.among_parts += 0.5 * difference * difference / paths;
    }
    pixel.among_paths = (squares - sum * sum / paths) / (paths - 1) - pixel.among_parts / parts;
    return pixel;
}

// Rounds to a power of two, so that differences in the last bits, as between accelerators that disagree on a ray, give
// the same plan.
float rounded(double x)
{
    if (!(x > 0)) return 0;
    int exponent = 0;
    const double mantissa = std::frexp(x, &exponent);
    return static_cast<float>(std::ldexp(1.0, mantissa < 0.70710678118654752 ? exponent - 1 : exponent));
}

// A grid of measured pixels.
struct PilotGrid {
    uint32_t cell, columns, rows;
    std::vector<PixelStatistics> pixels;
    std::array<double, 3> mean{};
    Counters counters;
    LightChoice choice;  // of lights
    // Their slot is the index of a pixel. Empty if nothing is to be learned.
    std::vector<Arrival> arrivals;

    double brightness() const { return luminance(mean[0], mean[1], mean[2]); }
    double floor() const { return dark * brightness(); }  // as bright as what is darker counts
    // The square of a pixel's radiance, to which its error is relative.
    double square_of(const PixelStatistics& pixel) const
    {
        const double y = luminance(pixel.mean[0], pixel.mean[1], pixel.mean[2]), least = floor();
        return y * y + least * least;
    }
};

// learns: where light sampling pays.
PilotGrid measure_grid(const Scene& scene, const Accelerator& accel, const Path& path, const KernelSettings& settings,
                       const KernelChoice& kernel, const Camera& camera, uint32_t width, uint32_t height, bool learns,
                       const std::stop_token& stop)
{
    // Light of the view segment does not depend on the plan. All other segments count, whether they are part of the
    // picture or not: the parts add up to the whole only with a common plan.
    Path pilot = path;
    pilot.parts = {};
    pilot.parts.emitters = false;
    SamplingPlan shared;
    shared.parts = parts;
    if (learns) shared.light_choice = choice_of_pilot(scene.lights);
    PilotGrid s;
    s.choice = shared.light_choice;
    s.cell = std::max(least_cell, (std::max(width, height) + most_cells - 1) / most_cells);
    s.columns = (width + s.cell - 1) / s.cell, s.rows = (height + s.cell - 1) / s.cell;
    s.pixels.resize(size_t{s.columns} * s.rows);
    std::vector<Counters> counters(s.rows);
    std::vector<std::vector<Arrival>> arrivals(s.rows);
    parallel_for(s.rows, [&](size_t row) {
        if (stop.stop_requested()) return;
        Workspace w;
        w.is_pilot = true;
        size_t named = 0;  // arrivals that know their pixel
        for (uint32_t first = 0; first < s.columns; first += paths) {
            const uint32_t end = std::min(s.columns, first + paths);
            const auto middle = [&](size_t cell, uint32_t size) {
                return std::min(static_cast<uint32_t>(cell) * s.cell + s.cell / 2, size - 1);
            };
            w.slots.clear();
            for (uint32_t column = first; column < end; ++column)
                for (uint32_t i = 0; i < paths * parts; ++i)
                    w.slots.push_back({middle(column, width), middle(row, height), i});
            trace_pilot({scene, shared}, accel, pilot, settings, kernel, camera, width, w, counters[row],
                        ArrivalListener(learns ? &arrivals[row] : nullptr));
            for (; named < arrivals[row].size(); ++named) {
                uint32_t& slot = arrivals[row][named].slot;
                slot = static_cast<uint32_t>(row) * s.columns + first + slot / (paths * parts);
            }
            for (uint32_t column = first; column < end; ++column)
                s.pixels[row * s.columns + column] =
                    measure_pixel(std::span<const RadianceSum>(w.queue.radiance)
                                      .subspan(size_t{column - first} * paths * parts, paths * parts));
        }
    });
    for (const Counters& c : counters) s.counters += c;
    if (s.counters.shadow_rays > 0 || scene.has_sky())
        for (const auto& row : arrivals) s.arrivals.insert(s.arrivals.end(), row.begin(), row.end());
    for (const PixelStatistics& pixel : s.pixels)
        for (size_t c = 0; c < 3; ++c) s.mean[c] += pixel.mean[c] / static_cast<double>(s.pixels.size());
    return s;
}

// The split with the lowest error at equal time: with variance v and cost c of the path before the split, and v', c'
// behind it, sqrt(v' c / (v c')). Bolin and Meyer, "An Error Metric for Monte Carlo Ray Tracing", 1997, after Arvo and
// Kirk.
uint32_t best_split(const PilotGrid& s, const LightTable& lights)
{
    // Part of the variance before the split that remains with low-discrepancy samples.
    const double by_tree = lights.tree ? lights.tree_share : 0;
    const double left = unsorted * by_tree + stratified * (1 - by_tree);
    double above = 0, below = 0;
    for (const PixelStatistics& pixel : s.pixels) {
        const double weight = s.square_of(pixel);
        if (!(weight > 0)) continue;
        above += pixel.among_paths / weight;
        below += pixel.among_parts / weight;
    }
    const auto count = [](uint64_t n) { return static_cast<double>(n); };
    const double camera = count(s.counters.camera_rays), bounce = count(s.counters.bounce_rays);
    const double shadow = occlusion * count(s.counters.shadow_rays) / (camera + bounce);
    const double first = (packed + shadow) * camera, rest = (1 + shadow) * bounce;
    if (!(below > 0) || !(rest > 0)) return 1;
    if (!(above > 0)) return most_split;
    const double best = std::sqrt(below * first / (left * above * rest));
    return best < 1 ? 1 : static_cast<uint32_t>(std::min(static_cast<float>(most_split), rounded(best)));
}

LightChoice best_light_choice(PilotGrid& s, const Scene& scene)
{
    if (s.arrivals.empty() || !(s.floor() > 0)) return {};
    double variance = 0;
    for (const PixelStatistics& pixel : s.pixels)
        variance += (stratified * pixel.among_paths + pixel.among_parts) / s.square_of(pixel);
    variance /= static_cast<double>(s.pixels.size());
    const auto count = [](uint64_t n) { return static_cast<double>(n); };
    const double work = (packed * count(s.counters.camera_rays) + count(s.counters.bounce_rays)) / occlusion +
                        count(s.counters.shadow_rays);
    for (Arrival& a : s.arrivals) {
        const auto shown = static_cast<float>(std::sqrt(s.square_of(s.pixels[a.slot])));
        a.brought /= shown, a.found /= shown;
    }
    const Sky sky = !scene.has_sky()                   ? Sky::none
                    : scene.environment_table          ? Sky::pictured
                    : scene.has_constant_environment() ? Sky::alone
                                                       : Sky::even;
    const PilotCost cost{variance * count(s.counters.camera_rays), work};
    return learn_light_choice(s.arrivals, scene.lights, s.choice, cost, sky);
}

// Mean of the cell and its neighbours: a single cell is noisy.
std::array<double, 3> smoothed_radiance(const PilotGrid& s, uint32_t column, uint32_t row)
{
    std::array<double, 3> shown{};
    double count = 0;
    for (uint32_t y = row == 0 ? 0 : row - 1; y < std::min(s.rows, row + 2); ++y)
        for (uint32_t x = column == 0 ? 0 : column - 1; x < std::min(s.columns, column + 2); ++x, ++count)
            for (size_t c = 0; c < 3; ++c) shown[c] += s.pixels[size_t{y} * s.columns + x].mean[c];
    for (double& c : shown) c /= count;
    return shown;
}

// Computes SamplingPlan::importance.
void estimate_importance(const PilotGrid& s, SamplingPlan& plan)
{
    if (!(s.brightness() > 0)) return;
    plan.cell = s.cell, plan.columns = s.columns;
    const double floor = s.floor();
    for (uint32_t row = 0; row < s.rows; ++row)
        for (uint32_t column = 0; column < s.columns; ++column) {
            const std::array<double, 3> shown = smoothed_radiance(s, column, row);
            const auto importance = [&](size_t c) {
                return rounded(s.mean[c] / std::sqrt(shown[c] * shown[c] + floor * floor));
            };
            plan.importance.push_back({importance(0), importance(1), importance(2)});
        }
}

}  // namespace

SamplingPlan make_plan(const Scene& scene, const Accelerator& accel, const Path& path, const KernelSettings& settings,
                       const KernelChoice& kernel, const Camera& camera, uint32_t width, uint32_t height,
                       const std::stop_token& stop)
{
    SamplingPlan plan;
    const bool learns = path.learned_nee && path.direct.nee && path.direct.mis && !scene.lights.pick.empty();
    if (!path.split && !path.roulette_by_pixel && !learns) return plan;
    PilotGrid s = measure_grid(scene, accel, path, settings, kernel, camera, width, height, learns, stop);
    if (stop.stop_requested()) return plan;
    if (path.split) plan.split = plan.parts = best_split(s, scene.lights);
    if (path.roulette_by_pixel) estimate_importance(s, plan);
    if (learns) plan.light_choice = best_light_choice(s, scene);
    return plan;
}

}  // namespace lancer
