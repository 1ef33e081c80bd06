// Analysis of the last pictures of a study's runs: brightness, and the worst blocks.
#pragma once

#include <map>

#include "app/study/work.h"
#include "report/study/page.h"

namespace lancer {

// The last pictures of the runs that did not fail: of (scene, method) in the order of seeds.
using LastPictures = std::map<std::pair<std::string, std::string>, std::vector<LastPicture>>;

// Adds the levels of all methods on this scene to the study; peers of another level than the reference are not ranked
// from then on. Throws Error if a picture cannot be read.
void add_levels(Study& study, const std::string& scene, const LastPictures& pictures, const Reference& reference);

// The worst blocks of the first pictures of all methods, as PNG files beside the study and as rows of its page. Those
// that may not be ranked are shown and choose none.
SceneCrops crops_of(const StudyWork& work, const Study& study, const std::string& scene, const LastPictures& pictures,
                    const Reference& reference);

}  // namespace lancer
