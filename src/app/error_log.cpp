#include "app/error_log.h"

#include "app/console.h"
#include "core/names.h"
#include "io/atomic_file.h"
#include "report/flip.h"

namespace lancer {
namespace {

std::optional<ComparedPicture> read_if_any(const std::string& path)
{
    if (path.empty()) return {};
    return read_compared(path);
}

void warn_of(const std::string& a, const std::string& b, const std::string& seed)
{
    print_problem("warning: " + a + " and " + b + " share their samples (seed " + seed +
                  "): errors come out too small; render one with another --seed");
}

}  // namespace

ErrorLog::ErrorLog(const RenderOptions& options)
    : path_(options.error_log), reference_(read_if_any(options.reference)), reference2_(read_if_any(options.reference2))
{
    text_ =
        "spp,wall_s,cpu_s,camera_rays,bounce_rays,shadow_rays,rmse,relmse,relmse_trimmed,relmse_unbiased,smape,flip,"
        "estimated_error,estimated_low,estimated_high\n";
}

void ErrorLog::require_size(const Image& picture) const
{
    for (const auto* reference : {&reference_, &reference2_})
        if (*reference) require_same_windows(picture, (*reference)->image);
}

void ErrorLog::warn_of_shared_samples(uint64_t seed) const
{
    for (const auto* reference : {&reference_, &reference2_})
        if (*reference && (*reference)->said("seed") == std::to_string(seed))
            warn_of("this picture", in_quotes((*reference)->path), std::to_string(seed));
    if (!reference2_) return;
    if (const auto both = shared_seed(*reference_, *reference2_))
        warn_of(in_quotes(reference_->path), in_quotes(reference2_->path), *both);
}

void ErrorLog::add(const Image& picture, const RunStats& stats, double cpu_seconds)
{
    const auto number = [](std::optional<double> x) { return x ? shortest(*x) : std::string(); };
    const auto known = [&](double x) { return number(x > 0 ? std::optional(x) : std::nullopt); };
    last_.reset();
    if (reference_) last_ = compare(picture, reference_->image);
    const auto metric = [&](double Metrics::*which) { return last_ ? number((*last_).*which) : std::string(); };
    std::optional<double> unbiased;
    if (reference2_) unbiased = unbiased_squared_error(picture, reference_->image, reference2_->image);
    // Only where it is written down: it takes a while.
    const std::string flip = reference_ && !path_.empty() ? shortest(flip_hdr(picture, reference_->image).mean) : "";
    const double spp =
        static_cast<double>(stats.samples + stats.counters.dropped) / static_cast<double>(picture.pixels.size());
    const Counters& rays = stats.counters;
    for (const std::string& field :
         {number(spp), number(stats.render_s), number(cpu_seconds), std::to_string(rays.camera_rays),
          std::to_string(rays.bounce_rays), std::to_string(rays.shadow_rays), metric(&Metrics::rmse),
          metric(&Metrics::relmse), metric(&Metrics::relmse_trimmed), number(unbiased), metric(&Metrics::smape), flip,
          known(stats.estimated_error)})
        text_ += field + ",";
    text_ += known(stats.estimated_low) + "," + known(stats.estimated_high) + "\n";
    if (path_.empty()) return;
    write_text(path_, text_);
}

}  // namespace lancer
