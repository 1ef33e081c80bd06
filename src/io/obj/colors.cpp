#include "io/obj/colors.h"

#include <algorithm>
#include <array>
#include <limits>

#include "io/obj/repeated_warning.h"
#include "io/text_file.h"

namespace lancer {

std::vector<Color> read_vertex_colors(std::string_view text, const std::string& file, Diagnostics& diagnostics)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr Color unknown{-infinity, -infinity, -infinity};  // becomes white
    std::vector<Color> colors;
    RepeatedWarning none{"vertex without a colour among such that have one: white is taken"};
    RepeatedWarning broken{"vertex colour is not finite numbers: white is taken"};
    RepeatedWarning above{"vertex colour above 1: all colours are divided by 255"};
    RepeatedWarning outside{"vertex colour outside of its range cut off"};
    TextLines lines(text);
    while (lines.next()) {
        std::string_view rest = lines.line();
        if (take_word(rest) != "v") continue;
        rest = rest.substr(0, rest.find('#'));
        for (int i = 0; i < 3; ++i) take_word(rest);
        const std::array words{take_word(rest), take_word(rest), take_word(rest)};
        Color& color = colors.emplace_back(unknown);
        if (words[2].empty()) {
            none.add(lines.number());
            continue;
        }
        if (std::any_of(words.begin(), words.end(),
                        [](std::string_view w) { return classify_number(w) != NumberKind::finite; })) {
            broken.add(lines.number());
            continue;
        }
        const auto number = [&](size_t i) {
            constexpr double most = std::numeric_limits<float>::max();
            return static_cast<float>(std::clamp(number_value(words[i]), -most, most));
        };
        color = {number(0), number(1), number(2)};
        if (max_component(color) > 1) above.add(lines.number());
        if (std::min({color.r, color.g, color.b}) < 0 || max_component(color) > 255) outside.add(lines.number());
    }
    const float most = above.count ? 255.0f : 1.0f;
    for (Color& c : colors) {
        if (c == unknown) {
            c = {1, 1, 1};
            continue;
        }
        const auto part = [&](float x) { return std::clamp(x / most, 0.0f, 1.0f); };
        c = {part(c.r), part(c.g), part(c.b)};
    }
    for (const RepeatedWarning* w : {&none, &broken, &above, &outside}) w->give(file, diagnostics);
    return colors;
}

}  // namespace lancer
