#include "report/page/number_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace lancer {
namespace {

std::string format(double x, std::chars_format form, int precision)
{
    std::array<char, 400> buffer;  // the largest double has 309 digits
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x, form, precision);
    return {buffer.data(), end.ptr};
}

std::string superscript(int n)
{
    static constexpr std::array<const char*, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = n < 0 ? "⁻" : "";
    for (const char c : std::to_string(std::abs(n))) text += digits[static_cast<size_t>(c - '0')];
    return text;
}

// Plain where that is short, else a mantissa and a power of ten. Decided after rounding: 9.999 is 10.0, not 10.00.
std::string readable(double x, int digits, bool keep_zeros)
{
    if (!std::isfinite(x)) return "n/a";
    if (x == 0) return "0";
    const std::string text = format(x, std::chars_format::scientific, digits - 1);
    const size_t e = text.find('e');
    std::string mantissa = text.substr(0, e);
    const int exponent = std::atoi(text.c_str() + e + 1);
    const int last_plain = keep_zeros ? 5 : 3;
    if (exponent >= -3 && exponent <= last_plain) {
        const std::string plain = format(x, std::chars_format::fixed, std::max(0, digits - 1 - exponent));
        if (keep_zeros || plain.find('.') == std::string::npos) return plain;
        const std::string cut = plain.substr(0, plain.find_last_not_of('0') + 1);
        return cut.back() == '.' ? cut.substr(0, cut.size() - 1) : cut;
    }
    if (!keep_zeros && mantissa.find('.') != std::string::npos) {
        mantissa.erase(mantissa.find_last_not_of('0') + 1);
        if (mantissa.back() == '.') mantissa.pop_back();
        if (mantissa == "1" || mantissa == "-1") return (x < 0 ? "-10" : "10") + superscript(exponent);
    }
    return mantissa + "·10" + superscript(exponent);
}

// Length of the valid UTF-8 sequence at the beginning of text, 0 if there is none.
size_t utf8_length(std::string_view text)
{
    const auto byte = [&](size_t i) { return static_cast<uint8_t>(text[i]); };
    if (byte(0) < 0x80) return 1;
    const size_t length = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
    if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < length) return 0;
    uint32_t code = byte(0) & (0x7fu >> length);
    for (size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0) != 0x80) return 0;
        code = code << 6 | (byte(i) & 0x3fu);
    }
    const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
    const bool no_character = (code >= 0xd800 && code < 0xe000) || code > 0x10ffff || (code & 0xfffffe) == 0xfffe;
    return overlong || no_character ? 0 : length;
}

}  // namespace

std::string significant(double x, int digits) { return readable(x, digits, true); }
std::string round_text(double x) { return readable(x, 6, false); }

std::string count_text(double x)
{
    return std::abs(x) < 0x1p53 && x == std::trunc(x) ? format(x + 0.0, std::chars_format::fixed, 0) : significant(x);
}

std::string fixed_text(double x, int decimals) { return format(x, std::chars_format::fixed, decimals); }

std::string escape_xml(std::string_view text)
{
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const size_t length = utf8_length(text);
        const char c = text[0];
        if (length == 0 || (static_cast<uint8_t>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7f)
            out += '?';
        else if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else if (c == '\'')
            out += "&#39;";
        else
            out += text.substr(0, length);
        text.remove_prefix(std::max<size_t>(length, 1));
    }
    return out;
}

}  // namespace lancer
