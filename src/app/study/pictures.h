// The pictures of a study: brightness of the last ones of its runs, their worst blocks, and the references.
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

// The reference, and the worst blocks of the first pictures of all methods, as PNG files beside the study and for its
// page. Methods that may not be ranked are shown and choose no block.
ScenePictures pictures_of(const StudyWork& work, const Study& study, const std::string& scene,
                          const LastPictures& pictures, const Reference& reference);

}  // namespace lancer
