#include "app/render/checkpoints.h"

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/console.h"
#include "app/system_info.h"
#include "core/error.h"
#include "core/names.h"

namespace lancer {
namespace {

constexpr double first_after = 10;  // seconds

void warn(const Error& problem) { print_as_warning(problem, "the render goes on without this checkpoint"); }

}  // namespace

Checkpoints::Checkpoints(const PictureRecipe& recipe, const Film& film)
    : path_(recipe.options.checkpoint),
      resume_(recipe.options.resume == "auto" ? recipe.options.checkpoint : recipe.options.resume),
      may_begin_anew_(recipe.options.resume == "auto"),
      identity_(are_wanted(recipe.options) ? identity_of(recipe.options, recipe.stats,
                                                         film.sets.empty() ? std::nullopt : std::optional(film.deal))
                                           : RenderIdentity{}),
      shard_(recipe.options.shard),
      interval_(recipe.options.checkpoint_interval),
      due_(wall_seconds() + std::min(first_after, interval_))
{
}

RenderState Checkpoints::read(const std::string& path, Film& film) const
{
    Checkpoint there = read_checkpoint(path);
    require_same(there.identity, identity_, path);
    if (there.state.shard != shard_ && !(there.state.shard.is_whole() && shard_.is_whole()))
        throw Error(ErrorKind::invalid_input, {path},
                    there.state.shard.is_whole() ? "this checkpoint is of the whole picture, not of a shard"
                                                 : format_text("this is shard %u of %u: lancer merge joins shards",
                                                               there.state.shard.index, there.state.shard.count));
    film = std::move(there.film);
    return std::move(there.state);
}

std::optional<RenderState> Checkpoints::resume(Film& film) const
{
    if (resume_.empty()) return {};
    std::error_code absent;
    const std::string before = checkpoint_before(resume_);
    const bool has_before = std::filesystem::exists(before, absent);
    if (may_begin_anew_ && !has_before && !std::filesystem::exists(resume_, absent)) return {};
    try {
        return read(resume_, film);
    } catch (const Error& problem) {
        if (!has_before) throw;
        std::optional<RenderState> state;
        try {
            state = read(before, film);
        } catch (const Error&) {
            throw problem;
        }
        print_problem(std::string(problem.what()) + "\n" + before + ": warning: the render goes on from this one");
        return state;
    }
}

bool Checkpoints::are_due() const { return !path_.empty() && wall_seconds() >= due_; }

void Checkpoints::begin_write(const PictureRecipe& recipe, const RenderState& state, const Film& film)
{
    if (path_.empty()) return;
    end_write();
    try {
        auto written = std::make_shared<UnseenCheckpoint>(path_, identity_, recipe, state, film);
        being_written_ = std::async([written = std::move(written)] { written->commit(); });
    } catch (const Error& problem) {
        warn(problem);
    }
    due_ = wall_seconds() + interval_;
}

void Checkpoints::end_write()
{
    if (!being_written_.valid()) return;
    try {
        being_written_.get();
    } catch (const Error& problem) {
        warn(problem);
    }
}

bool Checkpoints::write(const PictureRecipe& recipe, const RenderState& state, const Film& film)
{
    if (path_.empty()) return false;
    end_write();
    try {
        write_checkpoint(path_, identity_, recipe, state, film);
    } catch (const Error& problem) {
        warn(problem);
        return false;
    }
    return true;
}

std::vector<std::string> Checkpoints::rescue(const PictureRecipe& recipe, const RenderState& state,
                                             const Film& film) const
{
    for (const std::string& name : rescue_names(path_)) {
        try {
            write_checkpoint(name, identity_, recipe, state, film);
        } catch (const Error&) {
            continue;
        }
        print_note("what was rendered is rescued as " + in_quotes(name));
        return {name};
    }
    return {};
}

}  // namespace lancer
