#include "core/readable.h"

#include <iconv.h>

#include <array>
#include <cstdint>
#include <optional>

namespace lancer {
namespace {

// Nothing if the bytes are not text of this encoding, or if the system does not know it.
std::optional<std::string> converted(std::string_view bytes, const char* encoding)
{
    const iconv_t conversion = iconv_open("UTF-8", encoding);
    if (conversion == reinterpret_cast<iconv_t>(-1)) return {};
    std::string in(bytes), out(4 * bytes.size() + 4, '\0');
    char *from = in.data(), *to = out.data();
    size_t left = in.size(), room = out.size();
    const bool is_done = iconv(conversion, &from, &left, &to, &room) != static_cast<size_t>(-1) && left == 0;
    iconv_close(conversion);
    if (!is_done) return {};
    out.resize(out.size() - room);
    return out;
}

struct Range {
    uint8_t first, last;
    bool holds(char c) const { return static_cast<uint8_t>(c) >= first && static_cast<uint8_t>(c) <= last; }
};

// Whether bytes above ASCII are the first ones of pairs, all of them in these ranges.
template <size_t n, size_t m>
bool is_in_pairs(std::string_view bytes, const std::array<Range, n>& first, const std::array<Range, m>& second)
{
    const auto any = [](const auto& ranges, char c) {
        for (const Range& r : ranges)
            if (r.holds(c)) return true;
        return false;
    };
    for (size_t i = 0; i < bytes.size(); ++i) {
        if (static_cast<uint8_t>(bytes[i]) < 0x80) continue;
        if (!any(first, bytes[i]) || i + 1 == bytes.size() || !any(second, bytes[i + 1])) return false;
        ++i;
    }
    return true;
}

// The common characters of GB 2312 (its first level and symbols) and of JIS X 0208 in Shift JIS. The rare ones begin
// with bytes that are accented small letters in Windows-1252.
bool looks_chinese(std::string_view bytes)
{
    return is_in_pairs(bytes, std::array{Range{0xa1, 0xa9}, Range{0xb0, 0xd7}}, std::array{Range{0xa1, 0xfe}});
}
bool looks_japanese(std::string_view bytes)
{
    return is_in_pairs(bytes, std::array{Range{0x81, 0x84}, Range{0x88, 0x9f}},
                       std::array{Range{0x40, 0x7e}, Range{0x80, 0xfc}});
}

}  // namespace

std::string readable(std::string_view bytes)
{
    bool is_ascii = true;
    for (const char c : bytes) is_ascii = is_ascii && static_cast<uint8_t>(c) < 0x80;
    if (is_ascii) return std::string(bytes);
    std::optional<std::string> text = converted(bytes, "UTF-8");
    if (!text && looks_chinese(bytes)) text = converted(bytes, "GB18030");
    if (!text && looks_japanese(bytes)) text = converted(bytes, "CP932");
    if (!text) text = converted(bytes, "WINDOWS-1252");
    if (text) return *text;
    std::string marked;
    for (const char c : bytes) marked += static_cast<uint8_t>(c) < 0x80 ? c : '?';
    return marked;
}

}  // namespace lancer
