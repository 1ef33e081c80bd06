// Text in UTF-16, which some programs on Windows write.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lancer {

// The text in UTF-8, without its byte order mark. Nothing if the bytes do not begin with a mark of UTF-16, or with two
// ASCII letters in it. Halves of characters become U+FFFD.
std::optional<std::string> text_of_utf16(std::string_view bytes);

}  // namespace lancer
