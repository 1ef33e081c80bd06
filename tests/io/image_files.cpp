#include "io/image_files.h"

namespace lancer {

std::string pack_big(uint32_t v)
{
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(v >> shift & 255);
    return bytes;
}

std::string tiff(uint16_t bits, uint16_t samples, uint16_t sample_format, const std::string& pixels, uint16_t extra)
{
    const uint16_t entries = extra ? 11 : 10;
    const uint32_t bits_at = 8 + 2 + 12 * entries + 4, pixels_at = bits_at + 8;
    const auto entry = [](uint16_t tag, uint32_t value) {
        return pack<uint16_t>({tag, 4}) + pack<uint32_t>({1, value});
    };
    const std::string sample_bits =
        samples == 1 ? entry(258, bits) : pack<uint16_t>({258, 3}) + pack<uint32_t>({samples, bits_at});
    const std::string extra_samples = extra ? pack<uint16_t>({338, 3}) + pack<uint32_t>({1, extra}) : "";
    return "II*\0"s + pack<uint32_t>({8}) + pack<uint16_t>({entries}) + entry(256, 2) + entry(257, 2) + sample_bits +
           entry(259, 1) + entry(262, samples == 1 ? 1 : 2) + entry(273, pixels_at) + entry(277, samples) +
           entry(278, 2) + entry(279, static_cast<uint32_t>(pixels.size())) + extra_samples +
           entry(339, sample_format) + pack<uint32_t>({0}) + pack<uint16_t>({bits, bits, bits, bits}) + pixels;
}

// A palette of the four colours; clear, 0, 1, clear, 2, 3, end in codes of three bits.
std::string gif() { return "GIF89a\2\0\2\0\x81\0\0"s + top + bottom + ",\0\0\0\0\2\0\2\0\0\2\3\x44\xa8\x15\0;"s; }

// Without loss, by cwebp 1.2.4: RIFF, a size, WEBP, one chunk VP8L.
std::string webp()
{
    return "\x52\x49\x46\x46\x32\x00\x00\x00\x57\x45\x42\x50\x56\x50\x38\x4c\x26\x00\x00\x00\x2f\x01\x40\x00\x00"
           "\x1f\x20\x10\x20\x78\xf5\xbf\x60\x43\x20\x90\xe4\xef\x34\xdb\x42\x02\x82\xe4\xff\x62\xf3\x1f\xf8\xe4"
           "\xa8\xe0\x06\x0c\x11\xfd\x0f\x01"s;
}

// Blue first, alpha last, 32 bits, uncompressed.
std::string dds()
{
    return "DDS "s + pack<uint32_t>({124, 0x100f, 2, 2, 8, 0, 0}) + std::string(44, '\0') +
           pack<uint32_t>({32, 0x41, 0, 32, 0xff0000, 0xff00, 0xff, 0xff000000, 0x1000, 0, 0, 0, 0}) +
           "\0\0\xff\xff\0\xff\0\xff\xff\0\0\xff\x07\x64\xbc\xff"s;
}

std::string jpeg()
{
    return "\xff\xd8\xff\xdb\0\x43\0"s + std::string(64, '\1') + "\xff\xc0\0\x0b\x08\0\x08\0\x08\1\1\x11\0"s +
           "\xff\xc4\0\x14\0\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x09"s +
           "\xff\xc4\0\x14\x10\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0"s + "\xff\xda\0\x08\1\1\0\0\x3f\0\x78\x1f\xff\xd9"s;
}

std::string jpeg_of(const std::vector<int>& parts)
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

std::string inks_with_profile(uint32_t first, uint32_t tags)
{
    constexpr uint32_t header = 128, head = header + 4, tag = 12;
    std::string profile = pack_big(head + tags * tag) + std::string(header - 4, '\0');
    profile.replace(12, 12, "prtrCMYKLab ").replace(36, 4, "acsp") += pack_big(tags);
    for (uint32_t i = 0; i < tags; ++i) profile += pack_big(first + i) + pack_big(0) + pack_big(4);
    const std::string segment = "ICC_PROFILE\0\1\1"s + profile;
    const std::string length = pack_big(static_cast<uint32_t>(segment.size() + 2)).substr(2);
    return jpeg_of({168, 188, 78, 90}).insert(2, "\xff\xe2" + length + segment);
}

std::string png_chunk(const std::string& type, const std::string& data)
{
    const std::string checked = type + data;
    uint32_t crc = 0xffffffff;
    for (const char c : checked) {
        crc ^= static_cast<uint8_t>(c);
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320 : 0);
    }
    return pack_big(static_cast<uint32_t>(data.size())) + checked + pack_big(~crc);
}

std::string png(uint32_t width, uint32_t height, int depth, int kind, const std::string& rows,
                const std::string& chunks)
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

}  // namespace lancer
