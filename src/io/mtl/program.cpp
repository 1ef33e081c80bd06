#include "io/mtl/program.h"

#include <array>
#include <string>

#include "io/file_finder.h"

namespace lancer {
namespace {

struct Name {
    std::string_view text;  // in lower case
    MtlProgram program;
};
constexpr std::array names{Name{"blender", MtlProgram::blender}, Name{"keyshot", MtlProgram::keyshot},
                           Name{"meshlab", MtlProgram::meshlab}, Name{"sketchup", MtlProgram::sketchup}};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// "Blender 3.4.1 MTL File", "Blender v2.54": the whole part of the number that follows the name.
int version_after_name(std::string_view rest)
{
    while (!rest.empty() && (rest.front() == ' ' || rest.front() == 'v')) rest.remove_prefix(1);
    int version = 0;
    for (size_t i = 0; i < rest.size() && i < 3 && is_digit(rest[i]); ++i) version = 10 * version + (rest[i] - '0');
    return version;
}

}  // namespace

MtlOrigin origin_in_comment(std::string_view comment)
{
    const std::string lower = to_lower(comment);
    for (const Name& name : names)
        if (const size_t at = lower.find(name.text); at != std::string::npos)
            return {name.program, name.program == MtlProgram::blender
                                      ? version_after_name(std::string_view(lower).substr(at + name.text.size()))
                                      : 0};
    return {};
}

}  // namespace lancer
