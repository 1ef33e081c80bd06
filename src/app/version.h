#pragma once

#include <string>

namespace lancer {

// Several lines: the program, its libraries as loaded, how it was compiled.
std::string version_text();

std::string version_number();  // "0.1.0"
std::string version_date();    // of the version, not of the build: "2026-11-28"

std::string compiler_text();     // "gcc 12.2.0"
std::string instruction_text();  // what the program itself was compiled for

}  // namespace lancer
