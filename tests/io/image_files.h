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
std::string pack_big(uint32_t v);

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

// One directory at 8; the pixels come behind it and the list of bits for each sample. 2 x 2. extra: what a fourth
// sample is: 1 associated alpha, 2 alpha.
std::string tiff(uint16_t bits, uint16_t samples, uint16_t sample_format, const std::string& pixels,
                 uint16_t extra = 0);

// Of 2 x 2 steps, as above, opaque.
std::string gif();
std::string webp();
std::string dds();

// 8 x 8 of grey 188: all quantizers 1, a DC coefficient of 8 * (188 - 128) = 480 (one code for "9 bits", then its
// bits), then "end of block".
std::string jpeg();

// 8 x 8 of one colour, in as many parts as are given (Y, Cb, Cr; four for inks), each 32 to 63 from 128: then its code
// is "9 bits", as in jpeg().
std::string jpeg_of(const std::vector<int>& parts);

// Of four inks, with a colour profile of so many tags, named by the numbers from `first` on: no name that a reader
// knows. At most 5000 fit into one segment.
std::string inks_with_profile(uint32_t first, uint32_t tags);

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
std::string png_chunk(const std::string& type, const std::string& data);

// `rows` are the rows as stored, each behind its filter byte; `chunks` stand between the header and the pixels. kind: 0
// grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA.
std::string png(uint32_t width, uint32_t height, int depth, int kind, const std::string& rows,
                const std::string& chunks = {});

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

// Parts of 2 x 1 floats, uncompressed; each lists its channels in the order of the alphabet. The number at x of channel
// c of part p is value(p, c, x).
template <class Value>
std::string exr_of(const std::vector<std::vector<std::string>>& parts, const Value& value)
{
    const bool several = parts.size() > 1;
    std::string headers, chunks;
    std::vector<uint64_t> sizes;
    const auto attribute = [&](const std::string& name, const std::string& type, const std::string& bytes) {
        headers += name + '\0' + type + '\0' + pack<uint32_t>({static_cast<uint32_t>(bytes.size())}) + bytes;
    };
    for (size_t p = 0; p < parts.size(); ++p) {
        std::string list, row;
        for (size_t c = 0; c < parts[p].size(); ++c) {
            list += parts[p][c] + "\0"s + pack<int32_t>({2, 0, 1, 1});
            row += pack<float>({value(p, c, 0), value(p, c, 1)});
        }
        attribute("channels", "chlist", list + '\0');
        if (several) attribute("chunkCount", "int", pack<int32_t>({1}));
        attribute("compression", "compression", "\0"s);
        for (const char* window : {"dataWindow", "displayWindow"})
            attribute(window, "box2i", pack<int32_t>({0, 0, 1, 0}));
        attribute("lineOrder", "lineOrder", "\0"s);
        if (several) attribute("name", "string", "part" + std::to_string(p));
        attribute("pixelAspectRatio", "float", pack<float>({1}));
        attribute("screenWindowCenter", "v2f", pack<float>({0, 0}));
        attribute("screenWindowWidth", "float", pack<float>({1}));
        if (several) attribute("type", "string", "scanlineimage");
        headers += '\0';
        const std::string number = several ? pack<int32_t>({static_cast<int32_t>(p)}) : "";
        const std::string chunk = number + pack<int32_t>({0, static_cast<int32_t>(row.size())}) + row;
        sizes.push_back(chunk.size());
        chunks += chunk;
    }
    if (several) headers += '\0';
    std::string file = "\x76\x2f\x31\x01"s + pack<uint32_t>({several ? 0x1002u : 2u}) + headers;
    uint64_t place = file.size() + 8 * parts.size();
    for (const uint64_t size : sizes) {
        file += pack<uint64_t>({place});
        place += size;
    }
    return file + chunks;
}

}  // namespace lancer
