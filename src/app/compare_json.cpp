#include "app/compare_json.h"

#include "report/json_object.h"

namespace lancer {
namespace {

int64_t whole(size_t n) { return static_cast<int64_t>(n); }

JsonObject metrics_object(const Metrics& m, size_t pixels)
{
    JsonObject object;
    object.number("rmse", m.rmse);
    object.number("relmse", m.relmse);
    object.number("relmse_trimmed", m.relmse_trimmed);
    object.number("relmse_p99", m.relmse_p99);
    object.number("smape", m.smape);
    object.numbers("mean", m.mean);
    object.numbers("reference_mean", m.reference_mean);
    object.numbers("mean_ratio", m.mean_ratio);
    object.count("pixels", whole(pixels));
    object.count("differing_pixels", whole(m.differing_pixels));
    object.number("max_difference", m.max_difference);
    object.counts("max_at", std::vector<int64_t>{m.max_x, m.max_y});
    object.count("non_finite_pixels", whole(m.non_finite_pixels));
    object.count("reference_non_finite", whole(m.reference_non_finite));
    return object;
}

JsonObject flip_object(const Flip& flip)
{
    JsonObject object;
    object.number("mean", flip.mean);
    object.text("range", flip.exposures ? "HDR" : "LDR");
    object.number("weighted_median", flip.weighted_median);
    object.number("min", flip.min);
    object.number("max", flip.max);
    if (const auto& e = flip.exposures) object.numbers("exposures", std::vector{e->start, e->stop, double(e->count)});
    return object;
}

JsonObject noise_object(const NoiseTest& t)
{
    JsonObject object;
    object.count("pixels", whole(t.pixels));
    object.number("z_chi_square", t.chi_square);
    object.count("z_beyond_3", whole(t.beyond_3));
    object.count("beyond_10_sigma", whole(t.beyond_10));
    object.count("tiles", whole(t.tiles));
    object.count("tiles_beyond", whole(t.tiles_beyond));
    object.count("without_noise_apart", whole(t.quiet_differing));
    object.number("luminance_difference", t.difference);
    object.numbers("interval", std::vector{t.interval.low, t.interval.high});
    object.number("detectable_bias", t.detectable);
    object.flag("means_differ", t.means_differ());
    return object;
}

}  // namespace

std::string compare_json(const CompareOptions& options, const ComparedErrors& errors, const DifferingChannels& channels,
                         const std::optional<NoiseTest>& noise, const std::string& verdict)
{
    JsonObject all("lancer.compare/1");
    all.text("picture", options.picture);
    all.text("reference", options.reference);
    if (errors.unbiased) all.text("reference2", options.reference2);
    all.object("metrics", metrics_object(errors.metrics, errors.pixels));
    all.object("flip", flip_object(errors.flip));
    if (errors.beyond_one_step) all.count("beyond_one_step", whole(*errors.beyond_one_step));
    if (errors.unbiased) all.number("relmse_unbiased", *errors.unbiased);
    if (errors.reference_noise) all.number("reference_noise", *errors.reference_noise);
    std::vector<std::string> shared = errors.shared;
    shared.insert(shared.end(), errors.shared_with_second.begin(), errors.shared_with_second.end());
    all.texts("shared_samples", shared);
    JsonObject differing;
    for (const auto& [name, pixels] : channels.differing) differing.count(name, whole(pixels));
    all.count("further_channels", whole(channels.count));
    all.object("differing_channels", differing);
    if (noise) all.object("noise", noise_object(*noise));
    all.texts("maps", options.outputs);
    all.text("verdict", verdict);
    JsonObject limit;
    limit.text("metric", errors.judged_by);
    limit.number("error", errors.judged);
    if (options.fail_above) {
        limit.number("fail_above", *options.fail_above);
        limit.flag("passed", errors.judged <= *options.fail_above);
    }
    all.object("limit", limit);
    return all.to_text();
}

}  // namespace lancer
