// What decides the bits of a picture.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/options/options.h"
#include "core/film.h"
#include "report/stats_json.h"

namespace lancer {

// Names and values, the same for a render and for what it goes on from.
using RenderIdentity = std::vector<std::pair<std::string, std::string>>;

// The number of samples is a part of it only where it decides where they are taken or how they are halved. stats: of
// the run, with context, scene and settings.
RenderIdentity identity_of(const RenderOptions& options, const RunStats& stats, const Film& film);

}  // namespace lancer
