#include "io/utf16.h"

#include <cstdint>

namespace lancer {
namespace {

void append_utf8(std::string& out, uint32_t code)
{
    const auto tail = [&](int shift) { out += static_cast<char>(0x80 | (code >> shift & 0x3F)); };
    if (code < 0x80) {
        out += static_cast<char>(code);
    } else if (code < 0x800) {
        out += static_cast<char>(0xC0 | code >> 6);
        tail(0);
    } else if (code < 0x10000) {
        out += static_cast<char>(0xE0 | code >> 12);
        tail(6), tail(0);
    } else {
        out += static_cast<char>(0xF0 | code >> 18);
        tail(12), tail(6), tail(0);
    }
}

// Whether these are bytes of ASCII letters, each with a zero behind or before it.
bool is_ascii_text(std::string_view bytes, size_t letter)
{
    if (bytes.size() < 4) return false;
    for (const size_t i : {0, 2})
        if (bytes[i + letter] <= 0 || bytes[i + 1 - letter] != 0) return false;
    return true;
}

}  // namespace

std::optional<std::string> text_of_utf16(std::string_view bytes)
{
    const bool little = bytes.starts_with("\xFF\xFE") || is_ascii_text(bytes, 0);
    const bool big = bytes.starts_with("\xFE\xFF") || is_ascii_text(bytes, 1);
    if (!little && !big) return {};
    const auto unit = [&](size_t i) {
        const auto first = static_cast<uint8_t>(bytes[i]), second = static_cast<uint8_t>(bytes[i + 1]);
        return little ? uint32_t{first} | uint32_t{second} << 8 : uint32_t{second} | uint32_t{first} << 8;
    };
    constexpr uint32_t mark = 0xFEFF, replacement = 0xFFFD;
    std::string text;
    text.reserve(bytes.size() / 2);
    size_t first = 0;
    while (first + 1 < bytes.size() && unit(first) == mark) first += 2;  // some files have two
    for (size_t i = first; i + 1 < bytes.size(); i += 2) {
        uint32_t code = unit(i);
        if (code >= 0xD800 && code < 0xE000) {  // half of a pair
            const uint32_t next = i + 3 < bytes.size() ? unit(i + 2) : 0;
            const bool is_pair = code < 0xDC00 && next >= 0xDC00 && next < 0xE000;
            code = is_pair ? 0x10000 + ((code - 0xD800) << 10) + (next - 0xDC00) : replacement;
            if (is_pair) i += 2;
        }
        append_utf8(text, code);
    }
    return text;
}

}  // namespace lancer
