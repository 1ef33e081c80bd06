// Views of OpenColorIO: from linear light to the code values of a display, as a configuration of a studio or of ACES
// says. docs/aovs.md tells what is done, https://opencolorio.readthedocs.io what configurations are.
#pragma once

#include <string>

#include "io/image/to_bytes.h"

namespace lancer {

struct OcioChoice {
    std::string config;         // a file, or a name that the library knows; empty: none, a tone map is used
    std::string display, view;  // empty: the default of the configuration

    bool is_given() const { return !config.empty(); }
    friend bool operator==(const OcioChoice&, const OcioChoice&) = default;
};

struct OcioView {
    OcioChoice choice;  // with the names of display and view
    std::string input;  // what the configuration calls our linear Rec. 709
    CodeCurve curve;    // the same bits on every call; copies must not run at once
};

// Throws Error: usage where the configuration has no such display or view, invalid_input where it cannot be read,
// failed where the module lancer_ocio is not there.
OcioView open_ocio(const OcioChoice& choice);

}  // namespace lancer
