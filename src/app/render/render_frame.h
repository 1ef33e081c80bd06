// One picture as lancer render makes it, alone or as a frame of a film.
#pragma once

#include "app/frame_cache.h"
#include "app/options/options.h"
#include "app/signals.h"

namespace lancer {

struct FrameEnd {
    int code = 0;            // exit code
    bool was_there = false;  // its pictures were finished before: nothing was drawn
};

// Loads, builds, renders and writes. film: what earlier frames left, and what this one leaves; null: none. Throws
// Error.
FrameEnd render_frame(const RenderOptions& options, Signals& signals, FrameCache* film = nullptr);

}  // namespace lancer
