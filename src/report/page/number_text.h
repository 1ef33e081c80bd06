// Numbers and names as pages show them: the same in every locale. Used by plots, tables and pages.
#pragma once

#include <string>
#include <string_view>

namespace lancer {

// "12.3", "0.0123", "1.23·10⁷", with so many significant digits (1 to 17) and the zeros at the end; "n/a" for what is
// not a finite number.
std::string significant(double x, int digits = 3);

// As short as 6 digits allow, for numbers that are round: "0.5", "20", "5·10⁶".
std::string round_text(double x);

// A whole number with all its digits; anything else as significant().
std::string count_text(double x);

// So many digits after the point; for coordinates, so x must be finite.
std::string fixed_text(double x, int decimals);

// Text as it may stand between tags and in attributes of XML and HTML. Bytes that are no text in XML (control
// characters, broken UTF-8) become '?'.
std::string escape_xml(std::string_view text);

}  // namespace lancer
