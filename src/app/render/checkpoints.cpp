#include "app/render/checkpoints.h"

#include <algorithm>
#include <filesystem>

#include "app/console.h"
#include "app/system_info.h"
#include "core/error.h"

namespace lancer {
namespace {

constexpr double first_after = 10;  // seconds

}  // namespace

Checkpoints::Checkpoints(const RenderOptions& options, const RunStats& stats, const Film& film)
    : path_(options.checkpoint),
      resume_(options.resume == "auto" ? options.checkpoint : options.resume),
      may_begin_anew_(options.resume == "auto"),
      identity_(are_wanted() ? identity_of(options, stats, film) : RenderIdentity{}),
      interval_(options.checkpoint_interval),
      due_(wall_seconds() + std::min(first_after, interval_))
{
}

std::optional<RenderState> Checkpoints::resume(Film& film) const
{
    if (resume_.empty()) return {};
    std::error_code absent;
    const std::string before = checkpoint_before(resume_);
    const bool has_before = std::filesystem::exists(before, absent);
    if (may_begin_anew_ && !has_before && !std::filesystem::exists(resume_, absent)) return {};
    try {
        return read_checkpoint(resume_, identity_, film);
    } catch (const Error& problem) {
        if (!has_before) throw;
        std::optional<RenderState> state;
        try {
            state = read_checkpoint(before, identity_, film);
        } catch (const Error&) {
            throw problem;
        }
        print_problem(std::string(problem.what()) + "\n" + before + ": warning: the render goes on from this one");
        return state;
    }
}

bool Checkpoints::are_due() const { return !path_.empty() && wall_seconds() >= due_; }

bool Checkpoints::write(const RenderState& state, const Film& film)
{
    if (path_.empty()) return false;
    bool is_written = true;
    try {
        write_checkpoint(path_, identity_, state, film);
    } catch (const Error& problem) {
        is_written = false;
        print_as_warning(problem, "the render goes on without this checkpoint");
    }
    due_ = wall_seconds() + interval_;
    return is_written;
}

}  // namespace lancer
