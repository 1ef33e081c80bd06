#include "io/image/tga.h"

#include <algorithm>
#include <array>

#include "io/input_file.h"

namespace lancer {
namespace {

struct Header {
    uint8_t id_length;
    bool has_palette;
    uint8_t type;  // 1 palette, 2 true colour, 3 grey; 8 more for run-length encoding
    bool run_length;
    uint16_t palette_first, palette_count;
    uint8_t palette_bits;
    uint16_t width, height;
    uint8_t bits;
    uint8_t alpha_bits;
    bool right_first, top_first;
};

void read_exactly(InputFile& file, void* bytes, size_t count)
{
    if (file.read(bytes, count) != count) throw file.invalid("not a valid Targa file: the file ends too early");
}

Header read_header(InputFile& file)
{
    std::array<uint8_t, 18> b = {};
    read_exactly(file, b.data(), b.size());
    const auto word = [&](size_t i) { return static_cast<uint16_t>(b[i] | b[i + 1] << 8); };
    return {.id_length = b[0],
            .has_palette = b[1] != 0,
            .type = static_cast<uint8_t>(b[2] & ~8),
            .run_length = (b[2] & 8) != 0,
            .palette_first = word(3),
            .palette_count = word(5),
            .palette_bits = b[7],
            .width = word(12),
            .height = word(14),
            .bits = b[16],
            .alpha_bits = static_cast<uint8_t>(b[17] & 15),
            .right_first = (b[17] & 0x10) != 0,
            .top_first = (b[17] & 0x20) != 0};
}

bool is_color_depth(uint8_t bits) { return bits == 15 || bits == 16 || bits == 24 || bits == 32; }

size_t byte_count(uint8_t bits) { return (size_t{bits} + 7) / 8; }

void check(const InputFile& file, const Header& h)
{
    const bool depth_fits = (h.type == 1 && (h.bits == 8 || h.bits == 16)) || (h.type == 2 && is_color_depth(h.bits)) ||
                            (h.type == 3 && (h.bits == 8 || h.bits == 16));
    const bool palette_fits = h.has_palette ? is_color_depth(h.palette_bits) : h.type != 1;
    if (!depth_fits || !palette_fits) throw file.invalid("not a valid Targa file: unknown kind of pixels");
    const std::string size = std::to_string(h.width) + " x " + std::to_string(h.height);
    if (h.width == 0 || h.height == 0) throw file.invalid("not a valid Targa file: the picture is " + size);
    const uint64_t pixels = uint64_t{h.width} * h.height, pixel_bytes = byte_count(h.bits);
    if (pixels > static_cast<uint64_t>(max_image_pixels)) throw file.invalid("picture too large: " + size + " pixels");
    // A run is a count byte and one pixel and yields at most 128.
    const uint64_t least = h.run_length ? pixels / 128 * (1 + pixel_bytes) : pixels * pixel_bytes;
    if (least > file.size()) throw file.invalid("the file is too short for a picture of " + size + " pixels");
}

// 1 or 3 channels, one more with alpha.
uint32_t channels_of(const Header& h)
{
    const uint8_t bits = h.type == 1 ? h.palette_bits : h.bits;
    const bool can_have_alpha = h.type == 3 ? bits == 16 : bits == 32 || bits == 16;
    return (h.type == 3 ? 1u : 3u) + (can_have_alpha && h.alpha_bits > 0 ? 1u : 0u);
}

using Pixel = std::array<uint8_t, 4>;  // as many as there are channels

Pixel to_color(const Pixel& stored, uint8_t bits)
{
    if (bits == 24 || bits == 32) return {stored[2], stored[1], stored[0], stored[3]};
    const uint32_t word = stored[0] | uint32_t{stored[1]} << 8;
    const auto part = [&](uint32_t shift) { return static_cast<uint8_t>(((word >> shift & 31) * 255 + 15) / 31); };
    return {part(10), part(5), part(0), static_cast<uint8_t>(word & 0x8000 ? 255 : 0)};
}

class Decoder {
public:
    Decoder(InputFile& file, const Header& header) : file_(file), header_(header)
    {
        file_.seek(18 + uint64_t{header_.id_length});
        if (!header_.has_palette) return;
        Pixel stored = {};
        for (uint32_t i = 0; i < header_.palette_count; ++i) {
            read_exactly(file_, stored.data(), byte_count(header_.palette_bits));
            palette_.push_back(to_color(stored, header_.palette_bits));
        }
    }

    // The next pixel in the order of the file.
    Pixel next()
    {
        if (!header_.run_length) return read_pixel();
        if (left_ == 0) {
            uint8_t packet = 0;
            read_exactly(file_, &packet, 1);
            left_ = (packet & 127) + 1;
            repeated_ = (packet & 128) != 0;
            if (repeated_) pixel_ = read_pixel();
        }
        --left_;
        return repeated_ ? pixel_ : read_pixel();
    }

private:
    Pixel read_pixel()
    {
        Pixel b = {};
        read_exactly(file_, b.data(), byte_count(header_.bits));
        if (header_.type == 2) return to_color(b, header_.bits);
        if (header_.type == 3) return b;
        const uint32_t index = (b[0] | uint32_t{b[1]} << 8) - header_.palette_first;  // below the first: wraps, refused
        if (index >= palette_.size()) throw file_.invalid("not a valid Targa file: a colour beyond its palette");
        return palette_[index];
    }

    InputFile& file_;
    const Header& header_;
    std::vector<Pixel> palette_;
    int left_ = 0;  // pixels of the present packet still to come
    bool repeated_ = false;
    Pixel pixel_ = {};
};

}  // namespace

RasterHeader read_tga_header(const std::string& path)
{
    InputFile file(path);
    const Header header = read_header(file);
    check(file, header);
    return {.width = header.width, .height = header.height, .channels = channels_of(header)};
}

Raster read_tga(const std::string& path)
{
    InputFile file(path);
    const Header header = read_header(file);
    check(file, header);
    Decoder decoder(file, header);
    Raster raster = {
        .width = header.width, .height = header.height, .channels = channels_of(header), .bytes = {}, .floats = {}};
    raster.bytes.resize(raster.value_count());
    for (size_t row = 0; row < header.height; ++row) {
        const size_t y = header.top_first ? row : header.height - 1 - row;
        for (size_t column = 0; column < header.width; ++column) {
            const size_t x = header.right_first ? header.width - 1 - column : column;
            const Pixel pixel = decoder.next();
            std::copy_n(pixel.begin(), raster.channels, &raster.bytes[(y * header.width + x) * raster.channels]);
        }
    }
    return raster;
}

}  // namespace lancer
