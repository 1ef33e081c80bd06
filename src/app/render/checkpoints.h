// When a render writes its checkpoint, and what it goes on from.
#pragma once

#include <atomic>
#include <future>
#include <optional>

#include "app/options/options.h"
#include "app/render/checkpoint_file.h"

namespace lancer {

class Checkpoints {
public:
    // recipe, film: of this render, before its first sample.
    Checkpoints(const PictureRecipe& recipe, const Film& film);

    // Whether there are any: films must then be kept so that a render can go on from any pass.
    static bool are_wanted(const RenderOptions& options)
    {
        return !options.checkpoint.empty() || !options.resume.empty();
    }
    // What --resume asks for: the film is filled. Nothing if the render begins anew. A damaged file is passed over for
    // the one before it, with a warning. Throws Error as read_checkpoint(), or if it is of another picture or shard.
    std::optional<RenderState> resume(Film& film) const;
    // Whether it is time for the next one; the first is due after ten seconds. From any thread.
    bool are_due() const;
    // Writes one while the render goes on: returns when its bytes no longer need the film, and a thread of its own
    // waits for the disk. If it cannot be written, a warning says so, here or in the next call.
    void begin_write(const PictureRecipe& recipe, const RenderState& state, const Film& film);
    // Writes one; returns whether it is on the disk. If it cannot be, a warning says so.
    bool write(const PictureRecipe& recipe, const RenderState& state, const Film& film);

    // Of what write() could not write: another place beside it, else in the folder for temporary files. Its name, or
    // none.
    std::vector<std::string> rescue(const PictureRecipe& recipe, const RenderState& state, const Film& film) const;

private:
    RenderState read(const std::string& path, Film& film) const;
    // Waits for what begin_write() left to do.
    void end_write();

    std::string path_, resume_;  // empty: none
    bool may_begin_anew_ = false;
    RenderIdentity identity_;
    Shard shard_;
    double interval_;
    std::atomic<double> due_;          // in wall_seconds()
    std::future<void> being_written_;  // what begin_write() left to do
};

}  // namespace lancer
