#include "io/text_file.h"

#include <charconv>
#include <cstring>

namespace lancer {
namespace {

const char* find_byte(const char* begin, const char* end, char c)
{
    const void* p = begin == end ? nullptr : std::memchr(begin, c, static_cast<size_t>(end - begin));
    return p ? static_cast<const char*>(p) : end;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// "nan", "-inf", "1.#QNAN": what C libraries print instead of a number.
bool names_non_finite(std::string_view word)
{
    std::string lower;
    for (const char c : word.substr(0, 12)) lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
    const size_t sign = !lower.empty() && (lower[0] == '-' || lower[0] == '+') ? 1 : 0;
    const std::string_view name = std::string_view(lower).substr(sign);
    return name.starts_with("nan") || name == "inf" || name == "infinity" || name.starts_with("1.#");
}

// For a number with an exponent or very many digits.
NumberKind classify_range(std::string_view word, std::string_view exponent)
{
    if (!word.empty() && word[0] == '+') word.remove_prefix(1);
    const bool negative = !exponent.empty() && exponent[0] == '-';
    if (!exponent.empty() && (negative || exponent[0] == '+')) exponent.remove_prefix(1);
    while (exponent.size() > 1 && exponent[0] == '0') exponent.remove_prefix(1);
    // Beyond 308 even a zero is refused: the reader computes 0 * infinity.
    const bool beyond = exponent.size() > 3 || (exponent.size() == 3 && exponent > "308");
    if (beyond) return negative ? NumberKind::finite : NumberKind::not_finite;
    double value = 0;
    const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
    if (result.ec != std::errc::result_out_of_range) return NumberKind::finite;
    return word.find_first_of("123456789") < word.find_first_of(".eE") && !negative ? NumberKind::not_finite
                                                                                    : NumberKind::finite;
}

}  // namespace

TextLines::TextLines(std::string_view text, Rule ends_in_name)
    : ends_in_name_(ends_in_name),
      position_(text.data()),
      end_(text.data() + text.size()),
      newline_(find_byte(position_, end_, '\n'))
{
    has_return_ = find_byte(position_, end_, '\r') != end_;
    has_backslash_ = find_byte(position_, end_, '\\') != end_;
}

std::string_view TextLines::physical_line()
{
    // The next LF is remembered: a file of CR alone would otherwise be searched to its end for every line.
    if (newline_ < position_) newline_ = find_byte(position_, end_, '\n');
    const char* const begin = position_;
    const char* stop = newline_;
    position_ = newline_ == end_ ? end_ : newline_ + 1;
    if (has_return_) {
        const char* const cr = find_byte(begin, stop, '\r');
        if (cr != stop) {
            if (cr + 1 != newline_) position_ = cr + 1;
            stop = cr;
        }
    }
    ++count_;
    return {begin, static_cast<size_t>(stop - begin)};
}

bool TextLines::next()
{
    if (position_ == end_) return false;
    line_ = trim(physical_line());
    first_ = count_;
    if (!has_backslash_ || !line_.ends_with('\\') || line_.starts_with('#')) return true;
    if (ends_in_name_ && ends_in_name_(line_)) return true;
    joined_.clear();
    while (line_.ends_with('\\') && position_ != end_) {
        joined_.append(line_.substr(0, line_.size() - 1)) += ' ';
        line_ = trim(physical_line());
    }
    if (line_.ends_with('\\')) line_.remove_suffix(1);
    joined_.append(line_);
    line_ = trim(joined_);
    return true;
}

std::string_view trim(std::string_view s)
{
    while (!s.empty() && is_blank(s.front())) s.remove_prefix(1);
    while (!s.empty() && is_blank(s.back())) s.remove_suffix(1);
    return s;
}

std::string_view name_argument(std::string_view s)
{
    for (size_t i = 2; i < s.size(); ++i)
        if (s[i] == '#' && is_blank(s[i - 1])) return trim(s.substr(0, i));
    return trim(s);
}

NumberKind classify_number(std::string_view word)
{
    const char *p = word.data(), *const end = p + word.size();
    if (p != end && (*p == '-' || *p == '+')) ++p;
    const char* const digits = p;
    while (p != end && is_digit(*p)) ++p;
    auto count = p - digits;
    if (p != end && *p == '.') {
        const char* const fraction = ++p;
        while (p != end && is_digit(*p)) ++p;
        count += p - fraction;
    }
    constexpr auto not_a_number = NumberKind::not_a_number;
    if (count == 0) return names_non_finite(word) ? NumberKind::not_finite : not_a_number;
    if (p == end) return count <= 300 ? NumberKind::finite : classify_range(word, {});
    if (*p != 'e' && *p != 'E') return names_non_finite(word) ? NumberKind::not_finite : not_a_number;
    const char* const exponent = ++p;
    if (p != end && (*p == '-' || *p == '+')) ++p;
    if (p == end) return not_a_number;
    while (p != end && is_digit(*p)) ++p;
    if (p != end) return not_a_number;
    return classify_range(word, {exponent, static_cast<size_t>(end - exponent)});
}

double number_value(std::string_view word)
{
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    // Too small for double leaves zero.
    std::from_chars(word.data(), word.data() + word.size(), value);
    return value;
}

}  // namespace lancer
