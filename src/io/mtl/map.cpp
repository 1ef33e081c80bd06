#include "io/mtl/map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/names.h"
#include "io/file_finder.h"
#include "io/text_file.h"

namespace lancer {
namespace {

struct Option {
    std::string_view name;
    size_t numbers;  // at most; 0: a word follows
};
constexpr std::array<Option, 14> options{{{"-s", 3},
                                          {"-o", 3},
                                          {"-t", 3},
                                          {"-mm", 2},
                                          {"-bm", 1},
                                          {"-boost", 1},
                                          {"-texres", 1},
                                          {"-clamp", 0},
                                          {"-imfchan", 0},
                                          {"-colorspace", 0},
                                          {"-blendu", 0},
                                          {"-blendv", 0},
                                          {"-cc", 0},
                                          {"-type", 0}}};

class MapParser {
public:
    MapParser(std::string_view arguments, std::string_view key, const Location& where, Diagnostics& diagnostics)
        : rest_(arguments), key_(key), where_(where), diagnostics_(diagnostics)
    {
    }

    std::optional<MtlMap> parse()
    {
        map_.line = where_.line;
        while (take_option()) {
        }
        map_.file = path_of(name_argument(rest_));
        if (std::string whole = path_of(trim(rest_)); whole != map_.file) map_.whole = std::move(whole);
        if (!map_.file.empty()) return map_;
        warn("names no file");
        return {};
    }

private:
    static std::string path_of(std::string_view name)
    {
        if (name.size() > 1 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
        std::string path(name);
        std::replace(path.begin(), path.end(), '\\', '/');
        return path;
    }
    void warn(const std::string& what) { diagnostics_.warning(where_, std::string(key_) + " " + what); }

    bool take_option()
    {
        std::string_view rest = rest_;
        const std::string_view word = take_word(rest);
        const auto option = std::find_if(options.begin(), options.end(),
                                         [&](const Option& o) { return !word.empty() && o.name == word; });
        if (option == options.end()) return false;
        rest_ = rest;
        if (option->numbers)
            take_numbers(*option);
        else
            use_word(option->name, take_word(rest_));
        return true;
    }

    // As many as there are: "-s 2 wood.png" scales one axis only.
    void take_numbers(const Option& option)
    {
        // Beyond, a float of texture coordinates cannot tell one texel from the next.
        constexpr double most = 1 << 23;
        std::array<float, 3> values{};
        size_t n = 0;
        for (; n < option.numbers; ++n) {
            std::string_view rest = rest_;
            const std::string_view word = take_word(rest);
            const NumberKind kind = classify_number(word);
            if (kind == NumberKind::not_a_number) break;
            rest_ = rest;
            const double value = kind == NumberKind::finite ? number_value(word) : INFINITY;
            if (!(std::abs(value) <= most)) {
                warn("option " + std::string(option.name) + " beyond 8388608 ignored");
                return;
            }
            values[n] = static_cast<float>(value);
        }
        if (n == 0) return warn("option " + std::string(option.name) + " without a number");
        use_numbers(option.name, values, n);
    }

    void use_numbers(std::string_view name, const std::array<float, 3>& v, size_t n)
    {
        if (name == "-s") map_.scale = {v[0], n > 1 ? v[1] : 1};
        if (name == "-o") map_.offset = {v[0], v[1]};
        if (name == "-bm") map_.bump = v[0];
        if (name == "-mm") {
            map_.base = v[0];
            if (n > 1) map_.gain = v[1];
        }
        if (name == "-t" && v != std::array<float, 3>{}) warn("option -t (turbulence) is not supported");
    }

    void use_word(std::string_view name, std::string_view word)
    {
        const std::string value = to_lower(word);
        if (name == "-clamp" && value == "on") map_.wrap = Wrap::clamp;
        if (name == "-imfchan") use_channel(value);
        if (name == "-colorspace") {
            if (value == "srgb")
                map_.encoding = Encoding::srgb;
            else if (value == "linear")
                map_.encoding = Encoding::linear;
            else
                warn("option -colorspace " + in_quotes(word) + " is not supported");
        }
    }

    void use_channel(const std::string& value)
    {
        constexpr std::array<std::pair<char, Channel>, 5> known{{{'r', Channel::red},
                                                                 {'g', Channel::green},
                                                                 {'b', Channel::blue},
                                                                 {'m', Channel::alpha},
                                                                 {'l', Channel::luminance}}};
        for (const auto& [letter, channel] : known)
            if (value.size() == 1 && value[0] == letter) map_.channel = channel;
        if (!map_.channel) warn("option -imfchan " + in_quotes(value) + " is not supported");
    }

    std::string_view rest_, key_;
    const Location& where_;
    Diagnostics& diagnostics_;
    MtlMap map_;
};

}  // namespace

std::optional<MtlMap> parse_mtl_map(std::string_view arguments, std::string_view key, const Location& where,
                                    Diagnostics& diagnostics)
{
    return MapParser(arguments, key, where, diagnostics).parse();
}

}  // namespace lancer
