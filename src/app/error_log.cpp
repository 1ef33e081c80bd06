#include "app/error_log.h"

#include "app/console.h"
#include "io/atomic_file.h"
#include "io/image_read.h"
#include "report/flip.h"

namespace lancer {
namespace {

std::optional<Image> read_linear(const std::string& path)
{
    if (path.empty()) return {};
    return read_image(path, Encoding::srgb);
}

}  // namespace

ErrorLog::ErrorLog(const RenderOptions& options)
    : path_(options.error_log), reference_(read_linear(options.reference)), reference2_(read_linear(options.reference2))
{
    text_ =
        "spp,wall_s,cpu_s,camera_rays,bounce_rays,shadow_rays,rmse,relmse,relmse_trimmed,relmse_unbiased,smape,flip,"
        "estimated_error,estimated_low,estimated_high\n";
}

void ErrorLog::require_size(const Image& picture) const
{
    for (const auto* reference : {&reference_, &reference2_})
        if (*reference) require_same_windows(picture, **reference);
}

void ErrorLog::add(const Image& picture, const RunStats& stats, double cpu_seconds)
{
    const auto number = [](std::optional<double> x) { return x ? shortest(*x) : std::string(); };
    const auto known = [&](double x) { return number(x > 0 ? std::optional(x) : std::nullopt); };
    last_.reset();
    if (reference_) last_ = compare(picture, *reference_);
    const auto metric = [&](double Metrics::*which) { return last_ ? number((*last_).*which) : std::string(); };
    std::optional<double> unbiased;
    if (reference2_) unbiased = unbiased_squared_error(picture, *reference_, *reference2_);
    // Only where it is written down: it takes a while.
    const std::string flip = reference_ && !path_.empty() ? shortest(flip_hdr(picture, *reference_).mean) : "";
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
