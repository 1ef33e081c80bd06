// What the options of the command line say, as values: one function for each kind of text, in the words of our own
// messages. All throw Error (usage) and name the option.
#pragma once

#include <charconv>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/console.h"
#include "app/options/options.h"
#include "core/enum_names.h"
#include "core/names.h"
#include "scene/description/render_options.h"

namespace lancer {

[[noreturn]] void fail_usage(const std::string& message);

// Any of the numbers in [least, most]. what: "a whole number".
template <class T>
T to_number(const std::string& option, const std::string& text, T least, T most, const char* what)
{
    const auto shown = [](T x) {
        if constexpr (std::integral<T>)
            return std::to_string(x);
        else
            return shortest(x);
    };
    T value{};
    const char* const end = text.data() + text.size();
    const char* const begin = text.starts_with('+') ? text.data() + 1 : text.data();
    const auto [rest, problem] = std::from_chars(begin, end, value);
    if (problem != std::errc{} || rest != end || begin == end || !(value >= least && value <= most))
        fail_usage(option + ": " + in_quotes(text) + " is not " + what + " from " + shown(least) + " to " +
                   shown(most));
    return value;
}

inline constexpr uint32_t max_count = (uint32_t{1} << 31) - 1;
uint32_t to_count(const std::string& option, const std::string& text, uint32_t least, uint32_t most = max_count);

// The place of the text among the names.
size_t to_choice(const std::string& option, const std::string& text, std::span<const std::string_view> known);
template <NamedEnum E>
E to_enum(const std::string& option, const std::string& text)
{
    return static_cast<E>(to_choice(option, text, enum_names<E>));
}
// "a|b|c"
std::string listed(std::span<const std::string_view> names);
// The parts between separators; one, perhaps empty, if there are none.
std::vector<std::string> split(const std::string& text, char separator);

// The words of a command line that was quoted for a shell: blanks divide, a word in single quotes is kept as it is, and
// a backslash takes the next character as it is.
std::vector<std::string> words_of(const std::string& line);

// As the command line names it: "--max-depth".
std::string option_name(const RenderOption& option);

bool to_bool(const std::string& option, const std::string& text);               // "true" or "false"
PictureSize to_size(const std::string& option, const std::string& text);        // "1280x720"
FrameRange to_frames(const std::string& option, const std::string& text);       // "1-100", "7"
Tile to_crop(const std::string& text);                                          // "x0,y0,x1,y1"
double to_seconds(const std::string& option, const std::string& text);          // "90", "90s", "1.5m", "2h", "500ms"
MemorySize to_memory_size(const std::string& option, const std::string& text);  // "4G", "500M", "80%"
// A picture's name that says its format; one without an ending may do where a format is given. "-" is the standard
// output.
std::string to_output(const std::string& path, std::optional<PictureFormat> format);
void take_outputs(std::vector<std::string>& paths, std::optional<PictureFormat> format);  // each
// What --aov lists: AOVs, "all", and what is not among all.
std::vector<std::string_view> aov_words();
// "albedo,normal" or "all"; "lights", "parts", "cryptomatte", "denoise" and "oidn", which are not among all.
void add_aovs(const std::string& text, RenderOptions& options);
ViewDirection to_view(const std::string& text);                            // "front" or "30,15"
std::string listed_views();                                                // "front|...|AZIMUTH,ELEVATION"
Exposure to_exposure(const std::string& option, const std::string& text);  // "auto", "-0.5"
DisplayAddress to_display_address(const std::string& text);                // "host", "host:14158" or "[::1]:14158"

}  // namespace lancer
