// A report as one HTML page that needs nothing else: styles, plots, pictures and data stand in it, nothing is loaded.
// It can be read without scripts: only the slider between two pictures needs one, and stands in the middle without. It
// is well-formed XML as well, follows the reader's choice of light or dark, and prints.
#pragma once

#include <string>

#include "report/page/document.h"

namespace lancer {

// Error (failed) with the name of a picture that is no PNG.
std::string to_html(const Document& document);

// JSON as it may stand in a <script> of HTML and of XML: < > & only occur within strings, where they have an escape.
std::string json_for_html(const std::string& json);

}  // namespace lancer
