// When a render writes its checkpoint, and what it goes on from.
#pragma once

#include <atomic>
#include <optional>

#include "app/options/options.h"
#include "app/render/checkpoint_file.h"

namespace lancer {

class Checkpoints {
public:
    // stats, film: of this render, before its first sample.
    Checkpoints(const RenderOptions& options, const RunStats& stats, const Film& film);

    // Whether films must be kept so that a render can go on from any pass.
    bool are_wanted() const { return !path_.empty() || !resume_.empty(); }
    // What --resume asks for: the film is filled. Nothing if the render begins anew. A damaged file is passed over for
    // the one before it, with a warning. Throws Error as read_checkpoint().
    std::optional<RenderState> resume(Film& film) const;
    // Whether it is time for the next one; the first is due after ten seconds. From any thread.
    bool are_due() const;
    // Returns whether a file was written. If it cannot be, a warning says so, and the render goes on.
    bool write(const RenderState& state, const Film& film);

private:
    std::string path_, resume_;  // empty: none
    bool may_begin_anew_ = false;
    RenderIdentity identity_;
    double interval_;
    std::atomic<double> due_;  // in wall_seconds()
};

}  // namespace lancer
