#include "app/render/error_log.h"

#include "app/console.h"
#include "core/names.h"
#include "io/atomic_file.h"
#include "report/study/error_rows.h"

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
    text_ = error_rows_head();
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
    const Counters& rays = stats.counters;
    ErrorRow row;
    row.spp = static_cast<double>(stats.samples + rays.dropped) / static_cast<double>(picture.pixels.size());
    row.wall_s = stats.render_s, row.cpu_s = cpu_seconds;
    row.camera_rays = rays.camera_rays, row.bounce_rays = rays.bounce_rays, row.shadow_rays = rays.shadow_rays;
    if (stats.estimated_error) row.estimated_error = *stats.estimated_error;
    if (const auto& interval = stats.estimated_interval)
        row.estimated_low = interval->low, row.estimated_high = interval->high;
    last_.reset();
    // FLIP only where it is written down.
    if (reference_)
        last_ = measure_errors(row, picture, reference_->image, reference2_ ? &reference2_->image : nullptr,
                               !path_.empty());
    text_ += to_csv(row);
    if (path_.empty()) return;
    try {
        write_text(path_, text_);
        is_behind_ = false;
    } catch (const Error& problem) {
        if (!is_behind_) print_as_warning(problem, "the render goes on without its log");
        is_behind_ = true;
    }
}

}  // namespace lancer
