#include "io/scene/animation_target.h"

#include <algorithm>
#include <charconv>

#include "io/scene/definition.h"

namespace lancer {
namespace {

class TargetSearch {
public:
    TargetSearch(const std::string& key, const Location& where, TomlProblems& problems)
        : key_(key), where_(where), problems_(problems)
    {
    }

    // Nothing after a problem.
    std::optional<std::vector<std::string>> find(const TomlValue& root, std::vector<std::string> path)
    {
        if (path[0] == "animation" || path[0] == "version") return fail(in_quotes(path[0]) + " does not move");
        if (path.size() == 1 && path[0] != "camera")
            return fail(
                "it names a table, not a key in it such as 'light.0.intensity'; only 'camera' moves as a whole");
        const TomlValue* at = &root;
        for (size_t i = 0; i < path.size() && at; ++i) {
            const bool is_last = i + 1 == path.size();
            if (const auto* table = std::get_if<TomlValue::Table>(&at->data)) {
                at = value_at(*table, path[i]);
                // What a camera does not say is chosen; it may have no table.
                if (!at && (is_last || (i == 0 && path[0] == "camera"))) return path;
                if (!at) return fail("unknown " + in_quotes(path[i]) + suggestion(path[i], names(*table)));
            } else if (const auto* list = std::get_if<TomlValue::Array>(&at->data)) {
                const std::optional<size_t> place = place_in(*list, path[i]);
                if (!place) return {};
                path[i] = std::to_string(*place);
                at = &(*list)[*place];
            } else {
                return fail(in_quotes(path[i - 1]) + " is neither a table nor a list, so it has no " +
                            in_quotes(path[i]));
            }
        }
        return path;
    }

private:
    std::nullopt_t fail(const std::string& message)
    {
        problems_.add(where_, "the track of " + in_quotes(key_) + " has no target: " + message);
        return std::nullopt;
    }
    // Of the tables and lists in it.
    static NameList names(const TomlValue::Table& table)
    {
        NameList all;
        for (const TomlEntry& e : table)
            if (e.key != "animation" && (std::holds_alternative<TomlValue::Table>(e.value.data) ||
                                         std::holds_alternative<TomlValue::Array>(e.value.data)))
                all.push_back(e.key);
        return all;
    }
    std::optional<size_t> place_in(const TomlValue::Array& list, const std::string& part)
    {
        size_t place = 0;
        const auto [end, problem] = std::from_chars(part.data(), part.data() + part.size(), place);
        if (problem == std::errc{} && end == part.data() + part.size()) {
            if (place < list.size()) return place;
            return fail("the list has no entry " + in_quotes(part) + ": they count from 0, and there are " +
                        std::to_string(list.size()));
        }
        NameList known;
        for (size_t i = 0; i < list.size(); ++i)
            if (const auto* table = std::get_if<TomlValue::Table>(&list[i].data))
                for (const TomlEntry& e : *table)
                    if (const auto* name = std::get_if<std::string>(&e.value.data); name && e.key == "name") {
                        if (*name == part) return i;
                        known.push_back(*name);
                    }
        if (known.empty()) return fail("of a list one entry moves: a number must stand in place of " + in_quotes(part));
        return fail("unknown name " + in_quotes(part) + suggestion(part, known));
    }

    const std::string& key_;
    const Location& where_;
    TomlProblems& problems_;
};

}  // namespace

std::optional<std::vector<std::string>> find_target(const TomlValue& root, const std::string& key,
                                                    const Location& where, TomlProblems& problems)
{
    std::vector<std::string> path;
    try {
        const Definition read = parse_definition(key + "=0");
        if (read.value == "0") path = read.path;
    } catch (const Error&) {
        // Said below, in the words of this table.
    }
    if (path.empty()) {
        problems.add(where, in_quotes(key) + " is no key such as 'camera.fov' or 'light.0.intensity'");
        return {};
    }
    return TargetSearch(key, where, problems).find(root, std::move(path));
}

}  // namespace lancer
