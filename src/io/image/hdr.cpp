#include "io/image/hdr.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/atomic_file.h"

namespace lancer {
namespace {

// A byte above 128 announces a run of so many less 128, one up to 128 so many bytes as they stand.
constexpr size_t longest_run = 127, longest_copy = 128, shortest_run = 3;

size_t run_at(std::span<const uint8_t> bytes, size_t at)
{
    size_t end = at + 1;
    while (end < bytes.size() && end - at < longest_run && bytes[end] == bytes[at]) ++end;
    return end - at;
}

void pack(std::span<const uint8_t> bytes, std::vector<uint8_t>& out)
{
    for (size_t at = 0; at < bytes.size();) {
        if (const size_t run = run_at(bytes, at); run >= shortest_run) {
            out.insert(out.end(), {static_cast<uint8_t>(128 + run), bytes[at]});
            at += run;
            continue;
        }
        size_t end = at;
        while (end < bytes.size() && end - at < longest_copy && run_at(bytes, end) < shortest_run) ++end;
        out.push_back(static_cast<uint8_t>(end - at));
        out.insert(out.end(), &bytes[at], &bytes[at] + (end - at));
        at = end;
    }
}

std::string header_of(const Window& data, const Metadata& metadata)
{
    std::string text = "#?RADIANCE\nSOFTWARE=lancer\n";
    for (const auto& [name, value] : metadata) {
        std::string line = "lancer:" + name + "=" + to_string(value);
        std::replace_if(
            line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
        text += line + "\n";
    }
    // Rec. 709; without this line the primaries would be those of old monitors.
    text += "PRIMARIES=0.64 0.33 0.30 0.60 0.15 0.06 0.3127 0.3290\nFORMAT=32-bit_rle_rgbe\n\n";
    return text + "-Y " + std::to_string(data.height()) + " +X " + std::to_string(data.width()) + "\n";
}

}  // namespace

std::array<uint8_t, 4> to_rgbe(Color c)
{
    constexpr float largest = 0x1.fep126f;
    const auto in_range = [&](float x) { return x > 0 ? std::min(x, largest) : 0; };
    c = {in_range(c.r), in_range(c.g), in_range(c.b)};
    const float most = std::max({c.r, c.g, c.b});
    int exponent = 0;
    std::frexp(most, &exponent);
    if (std::ldexp(most, 8 - exponent) >= 255.5f) ++exponent;  // it would be rounded to 256
    if (most == 0 || exponent < -127) return {};
    const auto byte = [&](float x) { return static_cast<uint8_t>(std::ldexp(x, 8 - exponent) + 0.5f); };
    return {byte(c.r), byte(c.g), byte(c.b), static_cast<uint8_t>(exponent + 128)};
}

void write_hdr(AtomicFile& file, const ImageRows& image, const Metadata& metadata)
{
    const Window& data = image.data;
    if (data.empty()) throw Error(ErrorKind::failed, {file.path()}, "cannot write a picture without pixels");
    const std::string header = header_of(data, metadata);
    file.write(header.data(), header.size());
    const auto width = static_cast<size_t>(data.width());
    // The packed form has 15 bits for the width; below 8 it would be taken for pixels.
    const bool is_packed = width >= 8 && width < 32768;
    std::vector<Color> row(width);
    std::vector<uint8_t> planes(4 * width), out;
    for (int32_t y = data.y0; y < data.y1; ++y) {
        image.fill(y, row);
        out.clear();
        for (size_t x = 0; x < width; ++x) {
            const std::array<uint8_t, 4> pixel = to_rgbe(row[x]);
            for (size_t i = 0; i < 4; ++i) planes[is_packed ? i * width + x : 4 * x + i] = pixel[i];
        }
        if (is_packed) {
            out = {2, 2, static_cast<uint8_t>(width >> 8), static_cast<uint8_t>(width & 255)};
            for (size_t i = 0; i < 4; ++i) pack(std::span(planes).subspan(i * width, width), out);
        }
        const std::vector<uint8_t>& bytes = is_packed ? out : planes;
        file.write(bytes.data(), bytes.size());
    }
}

}  // namespace lancer
