#include "app/render/progress.h"

#include <algorithm>
#include <cmath>

#include "app/console.h"
#include "app/system_info.h"

namespace lancer {
namespace {

constexpr double settling = 2;  // seconds before the time left is more than a guess

std::string to_clock(double seconds)
{
    const auto s = std::llround(seconds);
    if (s < 3600) return format_text("%d:%02d", static_cast<int>(s / 60), static_cast<int>(s % 60));
    return format_text("%d:%02d:%02d", static_cast<int>(s / 3600), static_cast<int>(s / 60 % 60),
                       static_cast<int>(s % 60));
}

}  // namespace

Progress::Progress(ProgressKind kind, uint32_t spp, uint64_t pixels, std::optional<double> time_limit)
    : style_(kind == ProgressKind::none    ? Style::none
             : kind == ProgressKind::json  ? Style::json
             : kind == ProgressKind::plain ? Style::plain
             : stderr_is_terminal()        ? Style::line
                                           : Style::plain),
      spp_(spp),
      pixels_(pixels),
      time_limit_(time_limit),
      start_(wall_seconds()),
      next_(start_ + (style_ == Style::plain ? 10 : 0.25))
{
}

Progress::~Progress() { clear(); }

void Progress::begin_pass(SampleRange samples, size_t tiles)
{
    const std::lock_guard lock(mutex_);
    pass_ = samples;
    tiles_ = tiles;
    tiles_done_ = 0;
}

void Progress::tile_done()
{
    ++tiles_done_;
    if (style_ == Style::none) return;
    // Whoever finds another at it need not wait.
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    const double now = wall_seconds();
    if (now >= next_) print(now);
}

void Progress::end_pass(std::optional<double> error, uint64_t rays)
{
    const std::lock_guard lock(mutex_);
    error_ = error;
    rays_per_sample_ = static_cast<double>(rays) / (static_cast<double>(pixels_) * pass_.end);
    pass_.begin = pass_.end;
    if (style_ == Style::json) print(wall_seconds());
}

void Progress::clear()
{
    const std::lock_guard lock(mutex_);
    if (is_drawn_) print_raw("\r\x1b[K");
    is_drawn_ = false;
}

double Progress::samples() const
{
    const double part = static_cast<double>(tiles_done_) / static_cast<double>(tiles_);
    return pass_.begin + part * (pass_.end - pass_.begin);
}

double Progress::fraction(double elapsed) const
{
    const double of_samples = spp_ == 0 ? 0 : samples() / spp_;
    return std::min(1.0, std::max(of_samples, time_limit_ ? elapsed / *time_limit_ : 0));
}

void Progress::print(double now)
{
    const double elapsed = now - start_, done = fraction(elapsed);
    const double rate = elapsed > 0 ? samples() * static_cast<double>(pixels_) / elapsed : 0;
    const bool settled = elapsed >= settling && done > 0;
    const double left = done > 0 ? elapsed * (1 - done) / done : 0;
    // Redrawing less often as time goes by: four times a second in the beginning, once a second in the end.
    const double pause =
        style_ == Style::plain ? std::max(10.0, 0.05 * (elapsed + left)) : std::clamp(0.02 * elapsed, 0.25, 1.0);
    next_ = now + pause;
    if (style_ == Style::json) {
        const auto or_null = [](bool is_known, const char* format, double x) {
            return is_known ? format_text(format, x) : std::string("null");
        };
        const bool has_end = spp_ > 0 || time_limit_;
        print_raw(format_text("{\"t\":%.3f,\"phase\":\"render\",\"fraction\":", elapsed) +
                  or_null(has_end, "%.5f", done) + format_text(",\"spp\":%u,\"samples_per_s\":", pass_.begin) +
                  or_null(elapsed > 0, "%.0f", rate) +
                  ",\"rays_per_s\":" + or_null(rays_per_sample_ > 0, "%.0f", rate * rays_per_sample_) +
                  ",\"eta_s\":" + or_null(done > 0, "%.1f", left) +
                  ",\"error\":" + or_null(error_.has_value(), "%.6g", error_.value_or(0)) + "}\n");
        return;
    }
    std::string text = spp_ == 0 && !time_limit_ ? "render" : format_text("render %3.0f%%", std::floor(100 * done));
    text += spp_ == 0 ? format_text(" | %u spp | ", pass_.begin) : format_text(" | %u/%u spp | ", pass_.begin, spp_);
    text += rays_per_sample_ > 0 ? format_text("%.2f Mrays/s", 1e-6 * rate * rays_per_sample_)
                                 : format_text("%.2f Msamples/s", 1e-6 * rate);
    text += " | " + to_clock(elapsed) + " elapsed, " + (settled ? to_clock(left) : "-:--") + " left";
    if (error_) text += format_text(" | error < ~%.3g", *error_);
    if (style_ == Style::line) {
        print_raw("\r" + text + "\x1b[K");
        is_drawn_ = true;
    } else {
        print_raw(text + "\n");
    }
}

}  // namespace lancer
