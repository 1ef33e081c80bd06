// A table as text for a terminal.
#pragma once

#include <string>

#include "report/page/document.h"

namespace lancer {

// Columns of equal width, those of numbers flush right; without the caption. Cells must have one line.
std::string to_text(const Table& table);

}  // namespace lancer
