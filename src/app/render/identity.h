// What decides the bits of a picture.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/options/options.h"
#include "core/film.h"
#include "io/scene/output_table.h"
#include "report/stats_json.h"

namespace lancer {

// Names and values, the same for a render and for what it goes on from.
using RenderIdentity = std::vector<std::pair<std::string, std::string>>;

// The number of samples is a part of it only where it decides where they are taken or how they are halved. stats: of
// the run, with context, scene and settings. sets: how samples are dealt to sets, if they are.
RenderIdentity identity_of(const RenderOptions& options, const RunStats& stats, const std::optional<SetDeal>& sets);

// All that decides what is in the files of a frame, as 16 hexadecimal digits: known before it is drawn, and in its
// header (lancer:identity), so that a film knows what is finished. output: of the scene and the command line.
std::string frame_identity(const RenderOptions& options, const RunStats& stats, const OutputDescription& output);

// Of all that decides the value of a pixel, but the scene. settings: resolved; view: whose camera, and how the command
// line changes it, count.
std::string hash_of_settings(const RenderSettings& settings, const SceneChoice& view);

}  // namespace lancer
