// Whether a subject is a room: closed, and then seen from inside, or open on one side, and then seen through it.
#pragma once

#include <optional>

#include "scene/view/coarse_grid.h"
#include "scene/view/up_frame.h"

namespace lancer {

struct Enclosure {
    std::optional<double> open_azimuth_deg;  // the side that is open: 0, 90, 180 or 270
    struct Viewpoint {
        Vec3d position, ahead;  // units of the subject; ahead: as far as what is looked at
    };
    std::optional<Viewpoint> inside;  // from where a closed one is best seen
};

// Rays from points of a lattice inside tell how much of the box is surrounded by walls and a floor. Those of a closed
// room face inwards: else it is a body. Vessels are hollow as well, so walls must be at right angles to each other; and
// a room shows less from outside than inside.
Enclosure find_enclosure(const CoarseGrid& grid, const UpFrame& frame);

}  // namespace lancer
