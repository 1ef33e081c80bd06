#include "scene/build/overrides.h"

#include <fnmatch.h>

#include <algorithm>

namespace lancer {

const MaterialOverride* find_override(const SceneDescription& d, const std::string& material)
{
    const auto found = std::find_if(d.overrides.begin(), d.overrides.end(), [&](const MaterialOverride& o) {
        return fnmatch(o.match.c_str(), material.c_str(), 0) == 0;
    });
    return found == d.overrides.end() ? nullptr : &*found;
}

}  // namespace lancer
