#include "io/obj/check.h"

#include <set>

#include "core/names.h"
#include "io/file_content.h"
#include "io/text_file.h"

namespace lancer {
namespace {

size_t count_words(std::string_view text)
{
    size_t n = 0;
    for (std::string_view word = take_word(text); !word.empty() && word[0] != '#'; word = take_word(text)) ++n;
    return n;
}

}  // namespace

void check_obj_text(const std::string& path, Diagnostics& notes)
{
    const FileContent content(path, Unpack::yes);
    if (!content.problem().empty() || !content.is_text()) return;
    std::set<std::string, std::less<>> libraries;
    uint32_t first_polygon = 0;
    uint64_t polygons = 0;
    TextLines lines(content.text());
    while (lines.next()) {
        std::string_view line = lines.line();
        if (line.empty() || (line[0] != 'f' && line[0] != 'm')) continue;
        const std::string_view word = take_word(line);
        if (word == "f" && count_words(line) > 4 && polygons++ == 0) first_polygon = lines.number();
        if (word == "mtllib" && !libraries.insert(std::string(name_argument(line))).second)
            notes.warning({path, lines.number(), 0},
                          "the material library " + in_quotes(name_argument(line)) + " is named again");
    }
    if (polygons)
        notes.warning({path, first_polygon, 0}, "polygon of more than 4 corners, cut into triangles", polygons);
}

}  // namespace lancer
