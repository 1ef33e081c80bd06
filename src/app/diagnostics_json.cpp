#include "app/diagnostics_json.h"

#include <cctype>

namespace lancer {
namespace {

void add_place(JsonObject& object, const Location& where)
{
    if (where.file.empty()) return;
    object.text("file", where.file);
    if (where.line > 0) object.count("line", where.line);
    if (where.column > 0) object.count("column", where.column);
}

// Takes ":NUMBER" off the end of a place; 0 if there is none.
uint32_t take_number(std::string& place)
{
    size_t begin = place.size();
    while (begin > 0 && std::isdigit(static_cast<unsigned char>(place[begin - 1]))) --begin;
    if (begin == 0 || begin == place.size() || place.size() - begin > 9 || place[begin - 1] != ':') return 0;
    const auto number = static_cast<uint32_t>(std::stoul(place.substr(begin)));
    place.erase(begin - 1);
    return number;
}

}  // namespace

JsonObject error_object(const std::string& line)
{
    const std::string mark = "error: ";
    const size_t at = line.find(mark);
    JsonObject object;
    object.text("message", at == std::string::npos ? line : line.substr(at + mark.size()));
    if (at == std::string::npos || at < 2) return object;
    Location where{line.substr(0, at - 2)};
    const uint32_t last = take_number(where.file), before = last > 0 ? take_number(where.file) : 0;
    where.line = before > 0 ? before : last;
    where.column = before > 0 ? last : 0;
    add_place(object, where);
    return object;
}

std::vector<JsonObject> warning_objects(const Diagnostics& diagnostics)
{
    std::vector<JsonObject> objects;
    for (const Diagnostics::Warning& warning : diagnostics.warnings()) {
        JsonObject& object = objects.emplace_back();
        object.text("message", message_of(warning));
        add_place(object, warning.where);
        object.count("count", static_cast<int64_t>(warning.count));
        object.count("files", static_cast<int64_t>(warning.files.size()));
    }
    return objects;
}

}  // namespace lancer
