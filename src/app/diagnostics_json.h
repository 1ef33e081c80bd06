// Problems of scenes as JSON.
#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "report/json_object.h"

namespace lancer {

// Of a line "place: error: message": "message", and of the place "file", "line" and "column" as far as known.
JsonObject error_object(const std::string& line);
// The same of each warning, with its "count" and how many "files" it concerns.
std::vector<JsonObject> warning_objects(const Diagnostics& diagnostics);

}  // namespace lancer
