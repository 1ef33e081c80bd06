// Pictures in a page: their bytes stand in it, and one chooses among them without a script. Used by html.cpp.
#pragma once

#include <string>

#include "report/document.h"

namespace lancer {

// Radio buttons with the names of the pictures, and the pictures. Error (failed) for what is no PNG.
std::string flip_html(const PictureFlip& flip);

// The CSS that shows the chosen picture, for as many as the longest flip of the document has; empty without any.
std::string flip_style(const Document& document);

// RFC 4648, section 4.
std::string base64(const std::string& bytes);

}  // namespace lancer
