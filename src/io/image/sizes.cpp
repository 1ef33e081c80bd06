#include "io/image/sizes.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace lancer {
namespace {

template <size_t count>
std::array<uint8_t, count> read_start(InputFile& file, const char* format)
{
    std::array<uint8_t, count> bytes{};
    file.seek(0);
    if (file.read(bytes.data(), count) != count)
        throw file.invalid("not a valid " + std::string(format) + " file: the file ends too early");
    return bytes;
}

// Little-endian.
template <class Bytes>
uint32_t number(const Bytes& bytes, size_t at, size_t count)
{
    uint32_t n = 0;
    for (size_t i = 0; i < count; ++i) n |= uint32_t{bytes[at + i]} << 8 * i;
    return n;
}

template <class Bytes>
bool says(const Bytes& bytes, size_t at, std::string_view word)
{
    return std::equal(word.begin(), word.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                      [](char c, uint8_t b) { return static_cast<uint8_t>(c) == b; });
}

// Of bytes; the decoder has its own copy with four channels.
RasterHeader of_bytes(uint32_t width, uint32_t height, uint32_t channels)
{
    return {.width = width, .height = height, .channels = channels, .decoder_bytes = uint64_t{width} * height * 4};
}

}  // namespace

// "GIF Graphics Interchange Format", version 89a, section 18: the size of the canvas.
RasterHeader read_gif_size(InputFile& file)
{
    const auto b = read_start<10>(file, "gif");
    return of_bytes(number(b, 6, 2), number(b, 8, 2), 4);
}

// "WebP Container Specification": the first chunk is one of three.
RasterHeader read_webp_size(InputFile& file)
{
    const auto b = read_start<30>(file, "webp");
    if (says(b, 12, "VP8X")) return of_bytes(number(b, 24, 3) + 1, number(b, 27, 3) + 1, (b[20] & 0x10) != 0 ? 4 : 3);
    if (says(b, 12, "VP8L")) {
        const uint32_t bits = number(b, 21, 4);
        return of_bytes((bits & 0x3fff) + 1, (bits >> 14 & 0x3fff) + 1, (bits >> 28 & 1) != 0 ? 4 : 3);
    }
    if (says(b, 12, "VP8 ")) return of_bytes(number(b, 26, 2) & 0x3fff, number(b, 28, 2) & 0x3fff, 3);
    throw file.invalid("not a valid webp file: no picture at its beginning");
}

// "Programming Guide for DDS", structure DDS_HEADER. No format has fewer than half a byte for a pixel.
RasterHeader read_dds_size(InputFile& file)
{
    const auto b = read_start<128>(file, "dds");
    constexpr uint32_t cube_map = 0x200, volume = 0x200000, named = 4;
    if ((number(b, 112, 4) & (cube_map | volume)) != 0) throw file.invalid("cube maps and volumes are not read");
    const uint32_t height = number(b, 12, 4), width = number(b, 16, 4);
    if (uint64_t{width} * height / 2 > file.size())
        throw file.invalid("the file is too short for a picture of " + std::to_string(width) + " x " +
                           std::to_string(height) + " pixels");
    if ((number(b, 80, 4) & named) != 0) {
        constexpr std::string_view codes[] = {"DXT1", "DXT3", "DXT5", "ATI1", "ATI2", "BC4U", "BC5U", "DX10"};
        if (std::none_of(std::begin(codes), std::end(codes), [&](std::string_view code) { return says(b, 84, code); }))
            throw file.invalid("dds files with pixels of this kind are not read");
    } else {
        const uint32_t bits = number(b, 88, 4);
        bool fits = bits == 8 || bits == 16 || bits == 24 || bits == 32;
        for (size_t mask = 92; mask < 108; mask += 4) fits = fits && uint64_t{number(b, mask, 4)} >> bits == 0;
        if (!fits) throw file.invalid("not a valid dds file: unknown kind of pixels");
    }
    return of_bytes(width, height, 4);
}

// Recommendation T.81, B.1 and B.2.2: segments with their lengths, up to the frame header.
RasterHeader read_jpeg_size(InputFile& file)
{
    const auto broken = [&](const char* what) { return file.invalid("not a valid jpeg file: " + std::string(what)); };
    const auto byte = [&] {
        uint8_t b = 0;
        if (file.read(&b, 1) != 1) throw broken("the file ends too early");
        return b;
    };
    const auto word = [&] {
        const uint32_t high = byte();
        return high << 8 | byte();
    };
    file.seek(2);
    for (;;) {
        while (byte() != 0xff) {
        }
        uint8_t marker = 0xff;
        while (marker == 0xff) marker = byte();
        const bool stands_alone = marker == 0 || marker == 1 || (marker >= 0xd0 && marker <= 0xd8);
        if (stands_alone) continue;
        if (marker == 0xd9 || marker == 0xda) throw broken("no frame header");
        const uint32_t length = word();
        const bool is_frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
        if (is_frame) {
            byte();  // bits
            const uint32_t height = word(), width = word(), parts = byte();
            return {.width = width, .height = height, .channels = parts == 1 ? 1u : 3u, .decoder_bytes = file.size()};
        }
        file.seek(file.tell() + std::max(length, 2u) - 2);  // one that is too short is empty to libjpeg, too
    }
}

}  // namespace lancer
