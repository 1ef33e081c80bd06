// A study as JSON ("schema": "lancer.study/1"): everything of it, so that a report can be made again from the file.
// "time_to_error_ratio_to_baseline" is worked out from the rest and not read. Errors that were not measured are null,
// infinite ones "infinity"; numbers come back as the same bits.
#pragma once

#include <string>

#include "report/study/results.h"

namespace lancer {

// Texts that are not UTF-8 lose the bytes that are not.
std::string to_json(const Study& study);

// name: of the file, for messages. Throws Error(invalid_input) with the place of what is wrong: no JSON (line and
// column), no study, a wrong type or a missing key (its path, "runs[3].points[1].spp"), or what check_study() refuses.
Study read_study(const std::string& name, const std::string& json);

}  // namespace lancer
