// The words and tables of a report as Markdown, for the documentation. Plots, pictures, raw data and sections for the
// page only are left out.
#pragma once

#include <string>

#include "report/page/document.h"

namespace lancer {

// Sections become headings of this level, 1 to 6; the title is left to the page that the text becomes a part of.
std::string to_markdown(const Document& document, int level);

}  // namespace lancer
