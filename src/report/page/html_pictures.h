// Pictures in a page: their bytes stand in it, and one swaps and chooses among them without a script; one that is a
// single expression moves the slider. Used by html.cpp.
#pragma once

#include <string>

#include "report/page/document.h"

namespace lancer {

// The row, each picture with its name and caption, and the slider if there are two. Error (failed) for what is no PNG.
std::string pictures_html(const PictureRow& row);

// The gallery; the same error.
std::string gallery_html(const Gallery& gallery);

// The CSS of rows and galleries, for as many pictures as the longest of the document has; empty without any picture.
std::string pictures_style(const Document& document);

// RFC 4648, section 4.
std::string base64(const std::string& bytes);

}  // namespace lancer
