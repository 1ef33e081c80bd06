#include "io/scene/frame_tree.h"

#include <set>

#include "core/names.h"
#include "io/scene/definition.h"
#include "io/toml_file.h"
#include "io/toml_write.h"

namespace lancer {

TomlProblems problems_of(const std::string& path, const std::vector<std::string>& definitions)
{
    std::vector<std::string> sources{path};
    for (const std::string& text : definitions) sources.push_back("-D " + on_one_line(text));
    return TomlProblems(std::move(sources));
}

void define_all(TomlValue& root, const std::vector<std::string>& definitions, TomlProblems& problems)
{
    uint32_t source = 0;
    for (const std::string& text : definitions) {
        const Definition definition = parse_definition(text);
        TomlValue value = parse_toml_value(definition.value);
        set_source(value, ++source);
        define(root, definition, std::move(value), problems);
    }
}

void put_frame(TomlValue& root, const std::vector<FrameValue>& values, const std::vector<std::string>& definitions,
               TomlProblems& problems)
{
    std::set<std::vector<std::string>> defined;
    for (const std::string& text : definitions) defined.insert(parse_definition(text).path);
    for (const FrameValue& own : values)
        if (!defined.count(own.path)) define(root, {.path = own.path, .value = {}}, own.value, problems);
}

std::string text_of(const FrameValue& own)
{
    TomlValue::Table entry;
    for (const std::string& part : own.path) entry.push_back({.key = part, .value = {}});
    entry.back().value = own.value;
    return to_toml_text({.data = std::move(entry)});
}

}  // namespace lancer
