// The file from which an unfinished render goes on with the same bits; see docs/checkpoint-format.md.
#pragma once

#include <string>
#include <vector>

#include "app/render/identity.h"
#include "core/film.h"
#include "render/workspace.h"
#include "report/metrics/error_estimate.h"
#include "report/stats_json.h"

namespace lancer {

// Where a render has come to, besides its film.
struct RenderState {
    SampleRange pass{};      // the last pass that began; [0, 0) before the first
    std::vector<Tile> left;  // the tiles without its samples
    Counters counters;
    double wall_s = 0, cpu_s = 0;  // that rendering has taken so far
    std::vector<RunStats::Progress> passes;
    HalfBuffers halves;
    std::string error_log;  // its text so far
};

// Where the file before this one is kept.
inline std::string checkpoint_before(const std::string& path) { return path + ".old"; }

// Writes a whole file and keeps the one before as checkpoint_before(). Throws Error (failed); both are then as they
// were.
void write_checkpoint(const std::string& path, const RenderIdentity& identity, const RenderState& state,
                      const Film& film);

// Fills a film that has the size and the sums of the one that was written. Throws Error: missing_input; invalid_input
// for a file that is damaged, or one of another picture, with what differs.
RenderState read_checkpoint(const std::string& path, const RenderIdentity& identity, Film& film);

}  // namespace lancer
