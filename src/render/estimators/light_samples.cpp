#include "render/estimators/light_samples.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"
#include "render/estimators/arrivals.h"

namespace lancer {
namespace {

constexpr uint32_t direct_samples = 16;  // of each pixel and replicate
constexpr uint32_t pixels_at_once = 8;
constexpr uint32_t most_samples = 4;  // of light
constexpr double worth_more = 1.06;   // gain that is expected of twice as many, as it is estimated from few pixels

struct DirectNoise {
    std::vector<double> variances;  // per sample, of each pixel
    double variance = 0;            // their mean
    double shadows = 0;             // shadow rays per camera ray
};

// Measures two pictures of direct light, and of the emitters that the camera sees, with different random numbers, each
// well distributed: their difference is the noise that a picture has.
DirectNoise measure_direct(const View& view, const Accelerator& accel, const Path& path, KernelSettings settings,
                           const KernelChoice& kernel, const Camera& camera, uint32_t width,
                           std::span<const PilotPixel> pixels, const std::stop_token& stop)
{
    settings.replicates = 2;
    const size_t blocks = (pixels.size() + pixels_at_once - 1) / pixels_at_once;
    DirectNoise noise;
    noise.variances.resize(pixels.size());
    std::vector<Counters> counters(blocks);
    parallel_for(blocks, [&](size_t block) {
        if (stop.stop_requested()) return;
        const auto here = pixels.subspan(block * pixels_at_once,
                                         std::min<size_t>(pixels_at_once, pixels.size() - block * pixels_at_once));
        Workspace w;
        w.is_pilot = true;
        for (const PilotPixel& pixel : here)
            for (uint32_t i = 0; i < direct_samples * settings.replicates; ++i)
                w.slots.push_back({pixel.x, pixel.y, i});
        trace_pilot(view, accel, path, settings, kernel, camera, width, w, counters[block], ArrivalListener(nullptr));
        const RadianceSum* sample = w.queue.radiance.data();
        for (size_t k = 0; k < here.size(); ++k) {
            std::array<double, 2> sums{};
            for (uint32_t i = 0; i < direct_samples * settings.replicates; ++i, ++sample) {
                const Color c = sample->color();
                sums[settings.replicate_of(i)] += luminance(double{c.r}, double{c.g}, double{c.b});
            }
            const double difference = (sums[0] - sums[1]) / direct_samples,
                         mean = 0.5 * (sums[0] + sums[1]) / direct_samples;
            // Where the pilot's samples missed the light, these may have found it.
            const double square = std::max(here[k].square, mean * mean);
            if (square > 0 && std::isfinite(difference))
                noise.variances[block * pixels_at_once + k] = 0.5 * direct_samples * difference * difference / square;
        }
    });
    Counters all;
    for (const Counters& c : counters) all += c;
    for (const double v : noise.variances) noise.variance += v / static_cast<double>(pixels.size());
    noise.shadows = static_cast<double>(all.shadow_rays) / static_cast<double>(std::max<uint64_t>(1, all.camera_rays));
    return noise;
}

// What light sampling has of the variance with one sample, as two take half of it away: what the pixels show for
// certain, a standard error below their mean.
double variance_of_lights(const DirectNoise& one, const DirectNoise& two)
{
    const auto count = static_cast<double>(one.variances.size());
    const double mean = one.variance - two.variance;
    double squares = 0;
    for (size_t i = 0; i < one.variances.size(); ++i) {
        const double d = one.variances[i] - two.variances[i] - mean;
        squares += d * d;
    }
    return std::clamp(2 * (mean - std::sqrt(squares) / count), 0.0, one.variance);
}

// Variance times work with so many light samples. direct: with one; of_lights: what light sampling has of its variance.
double price(const PathCost& cost, const DirectNoise& direct, double of_lights, uint32_t lights)
{
    const double variance = direct.variance - of_lights * (1 - 1.0 / lights) + cost.below;
    const double first = cost.shadow * direct.shadows, deeper = std::max(0.0, cost.shadows - direct.shadows);
    return variance * (cost.camera + first * lights + cost.split * (cost.bounces + cost.shadow * deeper));
}

}  // namespace

uint32_t best_light_samples(const Scene& scene, const Accelerator& accel, const Path& path,
                            const KernelSettings& settings, const KernelChoice& kernel, const Camera& camera,
                            uint32_t width, const SamplingPlan& plan, std::span<const PilotPixel> pixels,
                            const PathCost& cost, const std::stop_token& stop)
{
    if (pixels.empty()) return 1;
    Path direct = path;
    direct.parts = {};
    direct.parts.indirect = false;
    SamplingPlan own = plan;
    own.split = own.parts = 1;
    own.importance.clear();
    const auto measured = [&](uint32_t lights) {
        own.light_samples = lights;
        return measure_direct({scene, own}, accel, direct, settings, kernel, camera, width, pixels, stop);
    };
    const DirectNoise one = measured(1);
    const auto pays = [&](double of_lights, uint32_t lights) {
        return price(cost, one, of_lights, lights) > worth_more * price(cost, one, of_lights, 2 * lights);
    };
    // Were all of it the noise of light sampling, two samples would take half away.
    if (!pays(one.variance, 1)) return 1;
    const double of_lights = variance_of_lights(one, measured(2));
    uint32_t best = 1;
    while (best < most_samples && pays(of_lights, best)) best *= 2;
    return best;
}

}  // namespace lancer
