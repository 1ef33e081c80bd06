#include "io/image/radiance.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace lancer {
namespace {

constexpr size_t longest_line = 4096;

std::string read_line(InputFile& file)
{
    std::string line;
    for (char c = 0; file.read(&c, 1) == 1 && c != '\n';) {
        if (line.size() == longest_line) throw file.invalid("not a valid hdr file: a line of its header is too long");
        line += c;
    }
    if (line.ends_with('\r')) line.pop_back();
    return line;
}

// The value of "NAME=value", blanks around it allowed.
std::optional<std::string> value_of(const std::string& line, const std::string& name)
{
    if (!line.starts_with(name)) return {};
    const size_t sign = line.find_first_not_of(' ', name.size());
    if (sign == std::string::npos || line[sign] != '=') return {};
    return line.substr(sign + 1);
}

// The numbers of a value, as many as `numbers` has; all above 0.
template <size_t count>
std::array<double, count> read_factors(const InputFile& file, const std::string& text)
{
    std::array<double, count> numbers{};
    size_t place = 0;
    for (double& number : numbers) {
        place = std::min(text.find_first_not_of(" \t+", place), text.size());
        const char* const begin = text.data() + place;
        const auto [rest, problem] = std::from_chars(begin, text.data() + text.size(), number);
        if (problem != std::errc{} || !(number > 0) || !std::isfinite(number))
            throw file.invalid("not a valid hdr file: a factor of its header is not a number above 0");
        place = static_cast<size_t>(rest - text.data());
    }
    return numbers;
}

// "-Y 512 +X 1024" and the other seven.
bool read_size(const std::string& line, RadianceHeader& header)
{
    struct Axis {
        char sign = 0, name = 0;
        long size = 0;
    } axes[2];
    const char* place = line.c_str();
    for (Axis& axis : axes) {
        while (*place == ' ') ++place;
        axis.sign = *place;
        if (axis.sign != '+' && axis.sign != '-') return false;
        axis.name = static_cast<char>(std::toupper(static_cast<unsigned char>(place[1])));
        if (axis.name != 'X' && axis.name != 'Y') return false;
        char* end = nullptr;
        axis.size = std::strtol(place + 2, &end, 10);
        if (end == place + 2 || axis.size <= 0 || axis.size > INT32_MAX) return false;
        place = end;
    }
    if (axes[0].name == axes[1].name) return false;
    header.columns_first = axes[0].name == 'X';
    const Axis &x = axes[header.columns_first ? 0 : 1], &y = axes[header.columns_first ? 1 : 0];
    header.from_right = x.sign == '-', header.from_bottom = y.sign == '+';
    header.width = static_cast<uint32_t>(x.size), header.height = static_cast<uint32_t>(y.size);
    return true;
}

}  // namespace

RadianceHeader read_radiance_header(InputFile& file)
{
    RadianceHeader header;
    std::array<double, 3> multiplied{1, 1, 1};
    file.seek(0);
    constexpr int most_lines = 4096;
    std::string line = "#?";
    for (int i = 0; i < most_lines && !line.empty(); ++i) {
        line = read_line(file);
        if (const auto exposure = value_of(line, "EXPOSURE"))
            for (double& m : multiplied) m *= read_factors<1>(file, *exposure)[0];
        if (const auto correction = value_of(line, "COLORCORR")) {
            const std::array<double, 3> factors = read_factors<3>(file, *correction);
            for (size_t c = 0; c < 3; ++c) multiplied[c] *= factors[c];
        }
        constexpr std::string_view prefix = "lancer:";
        if (const size_t sign = line.find('='); line.starts_with(prefix) && sign != std::string::npos)
            header.metadata.emplace_back(line.substr(prefix.size(), sign - prefix.size()), line.substr(sign + 1));
        if (const auto format = value_of(line, "FORMAT"); format && format->find("xyze") != std::string::npos)
            throw file.invalid("its pixels are in CIE XYZ; only RGB is read");
    }
    if (!read_size(read_line(file), header)) throw file.invalid("not a valid hdr file: no size of the picture");
    header.factor = {static_cast<float>(1 / multiplied[0]), static_cast<float>(1 / multiplied[1]),
                     static_cast<float>(1 / multiplied[2])};
    return header;
}

void apply_radiance_header(const RadianceHeader& h, Raster& raster)
{
    if (!(h.factor == Color{1, 1, 1}))
        for (size_t i = 0; i < raster.floats.size(); i += 3) {
            raster.floats[i] *= h.factor.r;
            raster.floats[i + 1] *= h.factor.g;
            raster.floats[i + 2] *= h.factor.b;
        }
    if (!h.is_turned()) return;
    const std::vector<float> stored = std::exchange(raster.floats, {});
    raster.width = h.width, raster.height = h.height;
    raster.floats.resize(stored.size());
    for (size_t y = 0; y < h.height; ++y)
        for (size_t x = 0; x < h.width; ++x) {
            const size_t column = h.from_right ? h.width - 1 - x : x, row = h.from_bottom ? h.height - 1 - y : y;
            const size_t pixel = h.columns_first ? column * h.height + row : row * h.width + column;
            std::copy_n(&stored[3 * pixel], 3, &raster.floats[3 * (y * h.width + x)]);
        }
}

}  // namespace lancer
