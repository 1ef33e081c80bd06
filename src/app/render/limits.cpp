#include "app/render/limits.h"

#include <algorithm>
#include <bit>

#include "app/system_info.h"

namespace lancer {
namespace {

constexpr uint32_t most_per_pass = 256;
constexpr uint32_t first_half = 8;  // samples; of so few, and as many again, something can be said
// Renders of so many begin with a pass of one sample: one that is stopped early leaves no tile black. Fewer samples
// take less time than the shorter passes cost.
constexpr uint32_t least_for_short_passes = 64;
// So many tell what the error is about; of fewer, all may have missed the same light.
constexpr uint32_t least_to_judge = 16;

}  // namespace

uint32_t RenderLimits::next_end(uint32_t done) const
{
    const uint32_t doubled = std::bit_ceil(done + 1);
    uint32_t end = std::min(doubled, done + most_per_pass);
    if (has_stop_rule())
        end = std::min(end, done + std::max(1u, done / 10));
    else if (!given_.looks_early && given_.spp < least_for_short_passes && done < first_half)
        end = done == 0 && given_.spp <= first_half ? given_.spp / 2 : first_half;
    return std::clamp(end, done + 1, given_.spp);
}

bool RenderLimits::looks_at_denoised(uint32_t samples)
{
    if (samples < least_to_judge || samples < looked_at_ + looked_at_ / 4) return false;
    looked_at_ = samples;
    return true;
}

bool RenderLimits::is_mark(uint32_t samples) const { return std::has_single_bit(samples) || samples == given_.spp; }

void RenderLimits::resume()
{
    is_running_ = true;
    wall_begin_ = lancer::wall_seconds(), cpu_begin_ = lancer::cpu_seconds();
}

void RenderLimits::pause()
{
    wall_ += lancer::wall_seconds() - wall_begin_, cpu_ += lancer::cpu_seconds() - cpu_begin_;
    is_running_ = false;
}

double RenderLimits::wall_seconds() const { return wall_ + (is_running_ ? lancer::wall_seconds() - wall_begin_ : 0); }

std::optional<Stop> RenderLimits::reached(uint32_t samples, std::optional<double> estimated) const
{
    if (samples >= given_.spp) return Stop::samples;
    if (given_.time && wall_seconds() >= *given_.time) return Stop::time;
    if (given_.error && estimated && samples >= least_to_judge && *estimated <= *given_.error) return Stop::error;
    return {};
}

}  // namespace lancer
