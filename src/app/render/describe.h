// What the figures of a run say of program, machine and scene.
#pragma once

#include "app/options/options.h"
#include "app/prepare.h"
#include "report/stats_json.h"

namespace lancer {

// Program and machine.
RunStats::Context describe_context(const RenderOptions& options);
// Fills in context, scene and the analyses of building it.
void describe_run(const RenderOptions& options, const Prepared& prepared, const Renderer& renderer, RunStats& stats);

}  // namespace lancer
