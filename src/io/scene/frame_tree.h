// The tree of a scene file, with definitions and the values of a frame put over it.
#pragma once

#include <string>
#include <vector>

#include "io/scene/animation.h"
#include "io/toml_reader.h"

namespace lancer {

// The file and the definitions, as messages name them.
TomlProblems problems_of(const std::string& path, const std::vector<std::string>& definitions);

// Puts the values of -D over the file's.
void define_all(TomlValue& root, const std::vector<std::string>& definitions, TomlProblems& problems);

// Puts the values of a frame over the file's, but for those that a definition gives: it comes before the film.
void put_frame(TomlValue& root, const std::vector<FrameValue>& values, const std::vector<std::string>& definitions,
               TomlProblems& problems);

// As text, so that the same values have the same hash.
std::string text_of(const FrameValue& own);

}  // namespace lancer
