// Reading text formats made of lines: a fast walk over the lines, and checks of single words. Used by the OBJ and MTL
// readers. Nothing here allocates per line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lancer {

// Walks over lines that end in LF, CR LF or CR. A backslash at the end of a line joins it with the next one, except
// in a line that is a comment or in which it belongs to a name. Lines are given without white space at both ends.
class TextLines {
public:
    using Rule = bool (*)(std::string_view line);
    // ends_in_name: whether the backslash at the end of this line is part of a name.
    explicit TextLines(std::string_view text, Rule ends_in_name = nullptr);
    bool next();  // false at the end
    std::string_view line() const { return line_; }
    uint32_t number() const { return first_; }  // of the first line, if several were joined

private:
    std::string_view physical_line();

    Rule ends_in_name_;
    const char *position_, *end_;
    const char* newline_;  // the first LF at or after position_, or end_
    bool has_return_, has_backslash_;
    uint32_t count_ = 0, first_ = 0;
    std::string_view line_;
    std::string joined_;
};

inline bool is_blank(char c) { return c == ' ' || c == '\t'; }
std::string_view trim(std::string_view s);

// Cuts the first word off text; empty at the end.
inline std::string_view take_word(std::string_view& text)
{
    size_t begin = 0, end = 0;
    while (begin < text.size() && is_blank(text[begin])) ++begin;
    for (end = begin; end < text.size() && !is_blank(text[end]);) ++end;
    const std::string_view word = text.substr(begin, end - begin);
    text.remove_prefix(end);
    return word;
}

// The rest of a line that is a name. It may contain spaces and '#'; a comment needs a space in front.
std::string_view name_argument(std::string_view s);

enum class NumberKind { finite, not_finite, not_a_number };

// Which of these a word is: a decimal number like -1, .5, 2. or 3e-7; a number or name beyond the range of double
// ("1e400", "inf", "nan"); or something else. Numbers too small for double are finite: zero.
NumberKind classify_number(std::string_view word);

// The value of a word that is a finite number.
double number_value(std::string_view word);

}  // namespace lancer
