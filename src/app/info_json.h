// What lancer info tells, as JSON ("lancer.info/1"): docs/json/info.schema.json.
#pragma once

#include <string>
#include <vector>

#include "app/scene_facts.h"
#include "core/error.h"
#include "render/profile.h"
#include "scene/specialisation.h"

namespace lancer {

// kernel: that draws the scene; diagnostics: of loading and building it.
std::string scene_json(const SceneFacts& facts, Profile kernel, const std::vector<UnusedFeature>& unused,
                       const Diagnostics& diagnostics);
// Of the header of a picture. Throws as its readers.
std::string picture_json(const std::string& path);

}  // namespace lancer
