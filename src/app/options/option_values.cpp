#include "app/options/option_values.h"

#include <algorithm>

#include "app/paths.h"
#include "io/net/display_server.h"

namespace lancer {
void fail_usage(const std::string& message) { throw Error(ErrorKind::usage, {}, message); }

uint32_t to_count(const std::string& option, const std::string& text, uint32_t least, uint32_t most)
{
    return to_number<uint32_t>(option, text, least, most, "a whole number");
}

size_t to_choice(const std::string& option, const std::string& text, std::span<const std::string_view> known)
{
    const auto it = std::find(known.begin(), known.end(), text);
    if (it == known.end()) fail_usage(option + ": unknown name " + in_quotes(text) + suggestion(text, known));
    return static_cast<size_t>(it - known.begin());
}

std::string listed(std::span<const std::string_view> names)
{
    std::string text;
    for (const std::string_view name : names) text += (text.empty() ? "" : "|") + std::string(name);
    return text;
}

std::vector<std::string> split(const std::string& text, char separator)
{
    std::vector<std::string> parts{""};
    for (const char c : text) {
        if (c == separator) {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

std::vector<std::string> words_of(const std::string& line)
{
    std::vector<std::string> words;
    bool is_open = false, is_quoted = false;
    for (size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (!is_quoted && c == ' ') {
            is_open = false;
            continue;
        }
        if (!is_open) words.emplace_back();
        is_open = true;
        if (c == '\'')
            is_quoted = !is_quoted;
        else if (c == '\\' && !is_quoted && i + 1 < line.size())
            words.back() += line[++i];
        else
            words.back() += c;
    }
    return words;
}

std::string option_name(const RenderOption& option)
{
    std::string name = "--" + std::string(option.name);
    std::replace(name.begin(), name.end(), '_', '-');
    return name;
}

bool to_bool(const std::string& option, const std::string& text)
{
    if (text != "true" && text != "false") fail_usage(option + ": " + in_quotes(text) + " is not true or false");
    return text == "true";
}

PictureSize to_size(const std::string& option, const std::string& text)
{
    const auto parts = split(text, 'x');
    if (parts.size() != 2) fail_usage(option + ": " + in_quotes(text) + " is not WIDTHxHEIGHT, such as 1280x720");
    const PictureSize size{to_count(option, parts[0], 1, max_picture_side),
                           to_count(option, parts[1], 1, max_picture_side)};
    if (uint64_t{size.width} * size.height > max_picture_pixels)
        fail_usage(option + ": " + in_quotes(text) + " is too large: at most 2^28 pixels");
    return size;
}

FrameRange to_frames(const std::string& option, const std::string& text)
{
    const std::vector<std::string> ends = split(text, '-');
    if (ends.size() > 2) fail_usage(option + ": " + in_quotes(text) + " is not A-B, as 1-100");
    const uint32_t first = to_count(option, ends[0], 0);
    return {first, ends.size() == 1 ? first : to_count(option, ends[1], first)};
}

Tile to_crop(const std::string& text)
{
    const auto parts = split(text, ',');
    if (parts.size() != 4)
        fail_usage("--crop: " + in_quotes(text) + " is not x0,y0,x1,y1 (pixels, x1 and y1 exclusive)");
    std::array<uint32_t, 4> c{};
    for (size_t i = 0; i < 4; ++i) c[i] = to_count("--crop", parts[i], 0, max_picture_side);
    if (c[0] >= c[2] || c[1] >= c[3])
        fail_usage("--crop: " + in_quotes(text) + " is empty: x0 < x1 and y0 < y1 are needed");
    return {c[0], c[1], c[2], c[3]};
}

double to_seconds(const std::string& option, const std::string& text)
{
    constexpr std::array<std::pair<std::string_view, double>, 4> units{
        {{"ms", 1e-3}, {"s", 1}, {"m", 60}, {"h", 3600}}};
    std::string_view digits = text;
    double unit = 1;
    for (const auto& [name, seconds] : units)
        if (text.ends_with(name)) {
            digits.remove_suffix(name.size()), unit = seconds;
            break;
        }
    double value = 0;
    const auto [rest, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (problem != std::errc{} || rest != digits.data() + digits.size() || !(value > 0 && value * unit <= 1e9))
        fail_usage(option + ": " + in_quotes(text) + " is not a time such as 90s, 1.5m, 2h or 500ms");
    return value * unit;
}

ViewDirection to_view(const std::string& text)
{
    const auto parts = split(text, ',');
    if (parts.size() == 2) {
        const auto degrees = [&](const std::string& part, double most) {
            return to_number<double>("--view", part, -most, most, "a number of degrees");
        };
        return {degrees(parts[0], 360), degrees(parts[1], 90)};
    }
    std::vector<std::string_view> known;
    for (const NamedView& view : named_views) known.push_back(view.name);
    known.push_back("AZIMUTH,ELEVATION");
    const size_t place = to_choice("--view", text, known);
    if (place == named_views.size()) fail_usage("--view: AZIMUTH,ELEVATION are two numbers of degrees, such as 30,15");
    return named_views[place].direction;
}

std::string listed_views()
{
    std::string text;
    for (const NamedView& view : named_views) text += std::string(view.name) + "|";
    return text + "AZIMUTH,ELEVATION";
}

MemorySize to_memory_size(const std::string& option, const std::string& text)
{
    constexpr std::array<std::pair<char, double>, 5> units{
        {{'K', 1e3}, {'M', 1e6}, {'G', 1e9}, {'T', 1e12}, {'%', 1e-2}}};
    std::string_view digits = text;
    double unit = 1;
    for (const auto& [name, bytes] : units)
        if (!digits.empty() && (digits.back() == name || (name != '%' && digits.back() == name - 'A' + 'a'))) {
            digits.remove_suffix(1), unit = bytes;
            break;
        }
    const bool is_part = text.ends_with('%');
    double value = 0;
    const auto [rest, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool is_number = problem == std::errc{} && rest == digits.data() + digits.size();
    if (!is_number || !(value * unit > 0 && value * unit <= (is_part ? 100 : 1e18)))
        fail_usage(option + ": " + in_quotes(text) + " is not a size such as 4G, 500M or 80%");
    return {value * unit, is_part};
}

std::string to_output(const std::string& path, std::optional<PictureFormat> format)
{
    if (format_of(path)) return path;
    const bool has_ending = !extension_of(path).empty();
    if (!format || has_ending)
        fail_usage("--output: " + in_quotes(path) + " must end in .exr, .png, .ppm, .jpg, .jpeg or .hdr" +
                   (has_ending ? "" : ", or --format say what it is"));
    return path == "-" ? standard_output : path;
}

void take_outputs(std::vector<std::string>& paths, std::optional<PictureFormat> format)
{
    for (std::string& path : paths) path = to_output(path, format);
}

Exposure to_exposure(const std::string& option, const std::string& text)
{
    if (text == "auto") return {.is_automatic = true};
    return {.stops = to_number<float>(option, text, -64, 64, "'auto' or a number")};
}

DisplayAddress to_display_address(const std::string& text)
{
    const std::string option = "--display-server";
    const bool in_brackets = text.starts_with('[');
    const size_t end = in_brackets ? text.find(']') : text.find(':');
    const std::string host = in_brackets ? text.substr(1, end - 1) : text.substr(0, end);
    const std::string rest = end == std::string::npos ? "" : text.substr(end + (in_brackets ? 1 : 0));
    if (host.empty() || (in_brackets && end == std::string::npos) || (!rest.empty() && rest[0] != ':') ||
        rest.find(':', 1) != std::string::npos)
        fail_usage(option + ": " + in_quotes(text) +
                   " is not HOST or HOST:PORT, such as localhost:14158 or [::1]:14158");
    if (rest.empty()) return {host, DisplayServer::default_port};
    return {host, static_cast<uint16_t>(to_count(option, rest.substr(1), 1, 65535))};
}

std::vector<std::string_view> aov_words()
{
    std::vector<std::string_view> known(enum_names<Aov>.begin(), enum_names<Aov>.end());
    for (const char* more : {"all", "lights", "parts", "lobes", "cryptomatte", "denoise", "oidn"})
        known.push_back(more);
    return known;
}

void add_aovs(const std::string& text, RenderOptions& options)
{
    std::vector<Aov>& aovs = options.aovs;
    const std::vector<std::string_view> known = aov_words();
    for (const std::string& part : split(text, ',')) {
        const size_t place = to_choice("--aov", part, known);
        for (size_t i = 0; i < enum_names<Aov>.size(); ++i)
            if (part == "all" || i == place) aovs.push_back(static_cast<Aov>(i));
        if (part == "lights") options.light_layers = true;
        if (part == "parts") options.part_layers = true;
        if (part == "lobes") options.lobe_layers = true;
        if (part == "cryptomatte") options.mattes = true;
        if (part == "denoise") options.denoise_sets = true;
        if (part == "oidn") options.guides = true;
    }
    std::sort(aovs.begin(), aovs.end());
    aovs.erase(std::unique(aovs.begin(), aovs.end()), aovs.end());
}

}  // namespace lancer
