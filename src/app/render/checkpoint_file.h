// The file from which an unfinished render goes on with the same bits; see docs/checkpoint-format.md.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/film.h"
#include "render/workspace.h"
#include "report/metrics/error_estimate.h"
#include "report/stats_json.h"

namespace lancer {

// What decides the bits of a picture: names and values, the same for a render and for what it goes on from.
using RenderIdentity = std::vector<std::pair<std::string, std::string>>;

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

// Writes a whole file and keeps the one before as PATH.old. Throws Error (failed); both are then as they were.
void write_checkpoint(const std::string& path, const RenderIdentity& identity, const RenderState& state,
                      const Film& film);

// Fills a film that has the size and the sums of the one that was written. Throws Error: missing_input; invalid_input
// for a file that is damaged, or one of another picture, with what differs.
RenderState read_checkpoint(const std::string& path, const RenderIdentity& identity, Film& film);

}  // namespace lancer
