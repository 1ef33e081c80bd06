#include "io/obj/colors.h"

#include <algorithm>
#include <array>

#include "io/text_file.h"

namespace lancer {
namespace {

// A warning and where it is due first.
struct Tally {
    const char* message;
    uint32_t line = 0;
    uint64_t count = 0;

    void add(uint32_t at)
    {
        if (count++ == 0) line = at;
    }
};

}  // namespace

std::vector<Color> read_vertex_colors(std::string_view text, const std::string& file, Diagnostics& diagnostics)
{
    std::vector<Color> colors;
    Tally none{"vertex without a colour among such that have one: white is taken"};
    Tally broken{"vertex colour is not finite numbers: white is taken"};
    Tally outside{"vertex colour outside of 0 to 1 cut off"};
    TextLines lines(text);
    while (lines.next()) {
        std::string_view rest = lines.line();
        if (take_word(rest) != "v") continue;
        rest = rest.substr(0, rest.find('#'));
        for (int i = 0; i < 3; ++i) take_word(rest);
        const std::array words{take_word(rest), take_word(rest), take_word(rest)};
        Color& color = colors.emplace_back(Color{1, 1, 1});
        if (words[2].empty()) {
            none.add(lines.number());
            continue;
        }
        if (std::any_of(words.begin(), words.end(),
                        [](std::string_view w) { return classify_number(w) != NumberKind::finite; })) {
            broken.add(lines.number());
            continue;
        }
        std::array<double, 3> said{};
        for (size_t i = 0; i < 3; ++i) said[i] = number_value(words[i]);
        if (std::any_of(said.begin(), said.end(), [](double x) { return x < 0 || x > 1; })) outside.add(lines.number());
        const auto cut = [](double x) { return static_cast<float>(std::clamp(x, 0.0, 1.0)); };
        color = {cut(said[0]), cut(said[1]), cut(said[2])};
    }
    for (const Tally* t : {&none, &broken, &outside})
        if (t->count) diagnostics.warning({file, t->line, 0}, t->message, t->count);
    return colors;
}

}  // namespace lancer
