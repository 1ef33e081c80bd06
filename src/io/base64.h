// Base64 (RFC 4648, section 4), as data URIs of glTF files have it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lancer {

// The bytes that a text stands for; nothing if it is not base64. Padding may be missing, and backslashes, which JSON
// may put before a '/', are no part of it.
inline std::optional<std::string> decode_base64(std::string_view text)
{
    static constexpr uint8_t skipped = 64, bad = 65;
    static constexpr std::array<uint8_t, 256> values = [] {
        std::array<uint8_t, 256> v{};
        v.fill(bad);
        constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        for (size_t i = 0; i < letters.size(); ++i) v[static_cast<unsigned char>(letters[i])] = static_cast<uint8_t>(i);
        v['\\'] = skipped;
        return v;
    }();
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    uint32_t bits = 0, count = 0;
    for (const char c : text) {
        const uint8_t value = values[static_cast<unsigned char>(c)];
        if (value == skipped) continue;
        if (value == bad) return {};
        bits = bits << 6 | value;
        if (++count % 4 != 0) continue;
        bytes += static_cast<char>(bits >> 16 & 255);
        bytes += static_cast<char>(bits >> 8 & 255);
        bytes += static_cast<char>(bits & 255);
    }
    if (count % 4 == 1) return {};
    if (count % 4 >= 2) bytes += static_cast<char>((count % 4 == 2 ? bits >> 4 : bits >> 10) & 255);
    if (count % 4 == 3) bytes += static_cast<char>(bits >> 2 & 255);
    return bytes;
}

}  // namespace lancer
