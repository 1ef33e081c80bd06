// Which axis of a mesh points upwards. Files do not say it: modelling programs for pictures write y, those for machines
// and printers z.
#pragma once

#include <string>

#include "scene/view/coarse_grid.h"

namespace lancer {

struct UpGuess {
    bool z = false;
    std::string why = {};  // for the log: "it stands flat on z = 0"; empty: nothing speaks against y
};

// z only on clear evidence: two of the signs below for z, and none for y.
UpGuess guess_up(const Subject& subject, const CoarseGrid& grid);

}  // namespace lancer
