#include "scene/build/overrides.h"

#include <fnmatch.h>

#include <algorithm>

namespace lancer {

bool is_overridden(const std::string& material, const std::string& pattern)
{
    return fnmatch(pattern.c_str(), material.c_str(), 0) == 0;
}

std::string pattern_of(const std::string& material)
{
    std::string pattern;
    for (const char c : material) {
        if (c == '*' || c == '?' || c == '[' || c == '\\') pattern += '\\';
        pattern += c;
    }
    return pattern;
}

const MaterialOverride* find_override(const SceneDescription& d, const std::string& material)
{
    const auto found = std::find_if(d.overrides.begin(), d.overrides.end(),
                                    [&](const MaterialOverride& o) { return is_overridden(material, o.match); });
    return found == d.overrides.end() ? nullptr : &*found;
}

}  // namespace lancer
