#include "io/tga.h"

#include <algorithm>
#include <array>
#include <cstring>

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

// A colour as stored, in integers of its depth; the table makes it linear. 5-bit parts are widened to 8.
Color to_color(const uint8_t* bytes, uint8_t bits, const std::vector<float>& table)
{
    if (bits == 24 || bits == 32) return {table[bytes[2]], table[bytes[1]], table[bytes[0]]};
    const uint32_t word = bytes[0] | uint32_t{bytes[1]} << 8;
    const auto part = [&](uint32_t shift) { return table[((word >> shift & 31) * 255 + 15) / 31]; };
    return {part(10), part(5), part(0)};
}

class Decoder {
public:
    Decoder(InputFile& file, const Header& header, Encoding encoding)
        : file_(file), header_(header), table_(make_linear_table(encoding, 256))
    {
        file_.seek(18 + uint64_t{header_.id_length});
        if (!header_.has_palette) return;
        std::array<uint8_t, 4> bytes = {};
        for (uint32_t i = 0; i < header_.palette_count; ++i) {
            read_exactly(file_, bytes.data(), byte_count(header_.palette_bits));
            palette_.push_back(to_color(bytes.data(), header_.palette_bits, table_));
        }
    }

    // The next pixel in the order of the file.
    Color next()
    {
        if (!header_.run_length) return read_pixel();
        if (left_ == 0) {
            uint8_t packet = 0;
            read_exactly(file_, &packet, 1);
            left_ = (packet & 127) + 1;
            repeated_ = (packet & 128) != 0;
            if (repeated_) color_ = read_pixel();
        }
        --left_;
        return repeated_ ? color_ : read_pixel();
    }

private:
    Color read_pixel()
    {
        std::array<uint8_t, 4> b = {};
        read_exactly(file_, b.data(), byte_count(header_.bits));
        if (header_.type == 2) return to_color(b.data(), header_.bits, table_);
        if (header_.type == 3) return {table_[b[0]], table_[b[0]], table_[b[0]]};     // a second byte is alpha
        const uint32_t index = (b[0] | uint32_t{b[1]} << 8) - header_.palette_first;  // below the first: wraps, refused
        if (index >= palette_.size()) throw file_.invalid("not a valid Targa file: a colour beyond its palette");
        return palette_[index];
    }

    InputFile& file_;
    const Header& header_;
    std::vector<float> table_;
    std::vector<Color> palette_;
    int left_ = 0;  // pixels of the present packet still to come
    bool repeated_ = false;
    Color color_;
};

}  // namespace

Image read_tga(const std::string& path, Encoding encoding)
{
    InputFile file(path);
    const Header header = read_header(file);
    check(file, header);
    Decoder decoder(file, header, encoding);
    Image image = make_image(header.width, header.height);
    for (int32_t row = 0; row < header.height; ++row) {
        const int32_t y = header.top_first ? row : header.height - 1 - row;
        for (int32_t column = 0; column < header.width; ++column) {
            const int32_t x = header.right_first ? header.width - 1 - column : column;
            image.at(x, y) = decoder.next();
        }
    }
    return image;
}

}  // namespace lancer
