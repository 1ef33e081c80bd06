// Names from files of unknown encoding, for messages.
#pragma once

#include <string>
#include <string_view>

namespace lancer {

// The bytes as UTF-8. Text that is not UTF-8 is taken for GB 18030 or Shift JIS where its bytes come in the pairs of
// these encodings, else for Windows-1252. Names alone do not tell an encoding for certain; the bytes themselves are
// what files and materials are found by.
std::string readable(std::string_view bytes);

}  // namespace lancer
