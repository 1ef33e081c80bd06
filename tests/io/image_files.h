// Small pictures of every format that the program reads, byte by byte.
#pragma once

#include <bitset>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace lancer {

using std::string_literals::operator""s;

// Little-endian bytes of numbers of the type asked for.
template <class T>
inline std::string pack(std::initializer_list<T> values)
{
    std::string bytes;
    for (const T v : values) bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
    return bytes;
}

// Most significant byte first.
inline std::string pack_big(uint32_t v)
{
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(v >> shift & 255);
    return bytes;
}

// Each of the following is a picture of 2 x 2 steps, top row first: (255, 0, 0) (0, 255, 0) | (0, 0, 255) (188, 100,
// 7).
inline const std::string top = "\xff\0\0\0\xff\0"s, bottom = "\0\0\xff\xbc\x64\x07"s;

inline std::string ppm() { return "P6\n2 2\n255\n" + top + bottom; }

// Rows bottom up, blue first, each padded to 4 bytes.
inline std::string bmp()
{
    return "BM" + pack<uint32_t>({70, 0, 54, 40, 2, 2}) + pack<uint16_t>({1, 24}) +
           pack<uint32_t>({0, 16, 2835, 2835, 0, 0}) + "\xff\0\0\x07\x64\xbc\0\0"s + "\0\0\xff\0\xff\0\0\0"s;
}

// Blue first; bit 5 of the last byte of the header says that the top row comes first.
inline std::string tga(bool top_first)
{
    const std::string first = "\0\0\xff\0\xff\0"s, second = "\xff\0\0\x07\x64\xbc"s;
    return "\0\0\2\0\0\0\0\0\0\0\0\0\2\0\2\0\x18"s + (top_first ? "\x20" + first + second : "\0"s + second + first);
}

// One directory at 8; the pixels come behind it and the list of bits for each sample.
inline std::string tiff(uint16_t bits, uint16_t samples, uint16_t sample_format, const std::string& pixels)
{
    constexpr uint16_t entries = 10;
    constexpr uint32_t bits_at = 8 + 2 + 12 * entries + 4, pixels_at = bits_at + 6;
    const auto entry = [](uint16_t tag, uint32_t value) {
        return pack<uint16_t>({tag, 4}) + pack<uint32_t>({1, value});
    };
    const std::string sample_bits =
        samples == 1 ? entry(258, bits) : pack<uint16_t>({258, 3}) + pack<uint32_t>({samples, bits_at});
    return "II*\0"s + pack<uint32_t>({8}) + pack<uint16_t>({entries}) + entry(256, 2) + entry(257, 2) + sample_bits +
           entry(259, 1) + entry(262, samples == 1 ? 1 : 2) + entry(273, pixels_at) + entry(277, samples) +
           entry(278, 2) + entry(279, static_cast<uint32_t>(pixels.size())) + entry(339, sample_format) +
           pack<uint32_t>({0}) + pack<uint16_t>({bits, bits, bits}) + pixels;
}

// 8 x 8 of grey 188: all quantizers 1, a DC coefficient of 8 * (188 - 128) = 480 (one code for "9 bits", then its
// bits), then "end of block".
inline std::string jpeg()
{
    return "\xff\xd8\xff\xdb\0\x43\0"s + std::string(64, '\1') + "\xff\xc0\0\x0b\x08\0\x08\0\x08\1\1\x11\0"s +
           "\xff\xc4\0\x14\0\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x09"s +
           "\xff\xc4\0\x14\x10\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0"s + "\xff\xda\0\x08\1\1\0\0\x3f\0\x78\x1f\xff\xd9"s;
}

// 8 x 8 of one colour, in as many parts as are given (Y, Cb, Cr; four for inks), each 32 to 63 from 128: then its code
// is "9 bits", as in jpeg().
inline std::string jpeg_of(const std::vector<int>& parts)
{
    const auto count = static_cast<char>(parts.size());
    std::string frame, scan, bits, coded;
    for (char i = 1; i <= count; ++i) frame += std::string(1, i) + "\x11\0"s, scan += std::string(1, i) + "\0"s;
    for (const int part : parts) {
        const int dc = 8 * (part - 128), stored = dc < 0 ? dc + 511 : dc;
        bits += "0" + std::bitset<9>(static_cast<unsigned>(stored)).to_string() + "0";
    }
    while (bits.size() % 8 != 0) bits += "1";
    for (size_t i = 0; i < bits.size(); i += 8)
        coded += static_cast<char>(std::bitset<8>(bits.substr(i, 8)).to_ulong());
    const auto length = [](size_t of) { return std::string(1, '\0') + static_cast<char>(of); };
    return "\xff\xd8\xff\xdb\0\x43\0"s + std::string(64, '\1') + "\xff\xc0" + length(8 + frame.size()) +
           "\x08\0\x08\0\x08"s + count + frame + "\xff\xc4\0\x14\0\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x09"s +
           "\xff\xc4\0\x14\x10\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0"s + "\xff\xda" + length(6 + scan.size()) + count +
           scan + "\0\x3f\0"s + coded + "\xff\xd9";
}

// Of four inks, with a colour profile of so many tags, named by the numbers from `first` on: no name that a reader
// knows. At most 5000 fit into one segment.
inline std::string inks_with_profile(uint32_t first, uint32_t tags)
{
    constexpr uint32_t header = 128, head = header + 4, tag = 12;
    std::string profile = pack_big(head + tags * tag) + std::string(header - 4, '\0');
    profile.replace(12, 12, "prtrCMYKLab ").replace(36, 4, "acsp") += pack_big(tags);
    for (uint32_t i = 0; i < tags; ++i) profile += pack_big(first + i) + pack_big(0) + pack_big(4);
    const std::string segment = "ICC_PROFILE\0\1\1"s + profile;
    const std::string length = pack_big(static_cast<uint32_t>(segment.size() + 2)).substr(2);
    return jpeg_of({168, 188, 78, 90}).insert(2, "\xff\xe2" + length + segment);
}

// (1, 2, 0.5) (0, 0, 0) | (100, 0, 0) (0.25, 0.5, 0.75), each with one exponent for its three mantissas.
inline std::string hdr()
{
    return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n\x40\x80\x20\x82\0\0\0\0\xc8\0\0\x87\x40\x80\xc0\x80"s;
}

// Floats, rows bottom up; the negative number says little-endian.
inline std::string pfm()
{
    return "PF\n2 2\n-1.0\n" + pack<float>({100, 0, 0, 0.25f, 0.5f, 0.75f, 1, 2, 0.5f, 0, 0, 0});
}

// One chunk of a PNG: length, type, data, checksum.
inline std::string png_chunk(const std::string& type, const std::string& data)
{
    const std::string checked = type + data;
    uint32_t crc = 0xffffffff;
    for (const char c : checked) {
        crc ^= static_cast<uint8_t>(c);
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320 : 0);
    }
    return pack_big(static_cast<uint32_t>(data.size())) + checked + pack_big(~crc);
}

// `rows` are the rows as stored, each behind its filter byte; `chunks` stand between the header and the pixels. kind: 0
// grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA.
inline std::string png(uint32_t width, uint32_t height, int depth, int kind, const std::string& rows,
                       const std::string& chunks = {})
{
    uint32_t a = 1, b = 0;
    for (const char c : rows) {
        a = (a + static_cast<uint8_t>(c)) % 65521;
        b = (b + a) % 65521;
    }
    const auto size = static_cast<uint16_t>(rows.size());
    const std::string deflated =
        "\x78\x01\x01"s + pack<uint16_t>({size, static_cast<uint16_t>(~size)}) + rows + pack_big(b << 16 | a);
    const std::string header =
        pack_big(width) + pack_big(height) + static_cast<char>(depth) + static_cast<char>(kind) + "\0\0\0"s;
    return "\x89PNG\r\n\x1a\n"s + png_chunk("IHDR", header) + chunks + png_chunk("IDAT", deflated) +
           png_chunk("IEND", "");
}

struct ExrFile {
    std::string channels = "ABGR";  // in the order of the alphabet
    int32_t width = 2, height = 2;
    std::vector<int32_t> display = {0, 0, 1, 1};  // both ends included, as the data window, which begins at (0, 0)
    bool mip_mapped = false;                      // one tile for each level
};

// An uncompressed EXR of floats: value(x, y, channel, level).
template <class Value>
std::string exr(const ExrFile& f, const Value& value)
{
    const auto attribute = [](const std::string& name, const std::string& type, const std::string& bytes) {
        return name + '\0' + type + '\0' + pack<uint32_t>({static_cast<uint32_t>(bytes.size())}) + bytes;
    };
    std::string list;
    for (const char c : f.channels) list += c + "\0"s + pack<int32_t>({2, 0, 1, 1});
    std::string file =
        "\x76\x2f\x31\x01"s + pack<uint32_t>({f.mip_mapped ? 0x202u : 2u}) +
        attribute("channels", "chlist", list + '\0') + attribute("compression", "compression", "\0"s) +
        attribute("dataWindow", "box2i", pack<int32_t>({0, 0, f.width - 1, f.height - 1})) +
        attribute("displayWindow", "box2i", pack<int32_t>({f.display[0], f.display[1], f.display[2], f.display[3]})) +
        attribute("lineOrder", "lineOrder", "\0"s) + attribute("pixelAspectRatio", "float", pack<float>({1})) +
        attribute("screenWindowCenter", "v2f", pack<float>({0, 0})) +
        attribute("screenWindowWidth", "float", pack<float>({1}));
    if (f.mip_mapped)
        file += attribute("tiles", "tiledesc",
                          pack<int32_t>({f.width, f.height}) + '\1');  // mip-mapped, sizes rounded down
    file += '\0';
    const auto row = [&](int32_t y, int32_t width, int32_t level) {
        std::string bytes;
        for (const char c : f.channels)
            for (int32_t x = 0; x < width; ++x) bytes += pack<float>({value(x, y, c, level)});
        return bytes;
    };
    std::vector<std::string> chunks;
    if (f.mip_mapped) {
        for (int32_t level = 0, w = f.width, h = f.height;; ++level) {
            std::string bytes;
            for (int32_t y = 0; y < h; ++y) bytes += row(y, w, level);
            chunks.push_back(pack<int32_t>({0, 0, level, level, static_cast<int32_t>(bytes.size())}) + bytes);
            if (w == 1 && h == 1) break;
            w = w > 1 ? w / 2 : 1, h = h > 1 ? h / 2 : 1;
        }
    } else {
        for (int32_t y = 0; y < f.height; ++y) {
            const std::string bytes = row(y, f.width, 0);
            chunks.push_back(pack<int32_t>({y, static_cast<int32_t>(bytes.size())}) + bytes);
        }
    }
    uint64_t place = file.size() + 8 * chunks.size();
    for (const std::string& chunk : chunks) {
        file += pack<uint64_t>({place});
        place += chunk.size();
    }
    for (const std::string& chunk : chunks) file += chunk;
    return file;
}

}  // namespace lancer
