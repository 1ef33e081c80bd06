// The file from which an unfinished render goes on with the same bits, and of which shards are merged; see
// docs/checkpoint-format.md.
#pragma once

#include <string>
#include <vector>

#include "app/render/checkpoint_stream.h"
#include "app/render/identity.h"
#include "app/render/recipe.h"
#include "core/film.h"
#include "io/file_content.h"
#include "render/counters.h"
#include "report/metrics/error_estimate.h"
#include "report/stats_json.h"

namespace lancer {

// Where a render has come to, besides its film.
struct RenderState {
    Shard shard;             // whose part of the picture it is
    std::vector<Tile> held;  // the tiles of which the film has samples: whole, those of a shard, or of some
    SampleRange pass{};      // the last pass that began; [0, 0) before the first
    std::vector<Tile> left;  // of them, those without its samples
    Counters counters;
    double wall_s = 0, cpu_s = 0;  // that rendering has taken so far
    std::vector<RunStats::Progress> passes;
    std::vector<HalfBuffers::Half> halves;  // as HalfBuffers::halves()
    std::optional<double> error;            // as HalfBuffers::rel_mse()
    std::string error_log;                  // its text so far
};

// A file that is checked and read, but for its film.
class CheckpointFile {
public:
    // Throws Error: missing_input; invalid_input if it is damaged or none.
    explicit CheckpointFile(const std::string& path);

    RenderIdentity identity;
    PictureRecipe recipe;
    RenderState state;  // without its halves
    // Adds the sums of the tiles that the state holds to a film of the recipe, and likewise the halves, if it has any.
    // Once. Throws Error (invalid_input).
    void read_film(Film& film, std::vector<HalfBuffers::Half>& halves);

private:
    FileContent content_;
    Loader from_;
};

// A whole file.
struct Checkpoint {
    RenderIdentity identity;
    PictureRecipe recipe;
    RenderState state;
    Film film;
};

// Where the file before this one is kept.
inline std::string checkpoint_before(const std::string& path) { return path + ".old"; }

// A checkpoint whose bytes are all written, while nothing of it is seen yet: what is left waits for the disk and needs
// neither film nor state.
class UnseenCheckpoint {
public:
    // Of the film only the tiles that the state holds are written. Throws Error (failed), as commit().
    UnseenCheckpoint(const std::string& path, const RenderIdentity& identity, const PictureRecipe& recipe,
                     const RenderState& state, const Film& film);
    // Puts it under its name once it is on the disk, and keeps the one before as checkpoint_before(). If it throws,
    // both files are as they were.
    void commit();

private:
    AtomicFile file_;
};

// Writes a whole file. Throws Error (failed).
void write_checkpoint(const std::string& path, const RenderIdentity& identity, const PictureRecipe& recipe,
                      const RenderState& state, const Film& film);

// Reads a whole file. Throws Error: missing_input; invalid_input if it is damaged or none.
Checkpoint read_checkpoint(const std::string& path);

// Throws Error (invalid_input) with what differs, if a file is not of the expected picture. path: of the file.
void require_same(const RenderIdentity& there, const RenderIdentity& expected, const std::string& path);

}  // namespace lancer
