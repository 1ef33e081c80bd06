// From where an object shows most of its detail.
#pragma once

#include "scene/view/coarse_grid.h"
#include "scene/view/up_frame.h"

namespace lancer {

// How much a viewer in that direction sees, as a product of two things. Of each cell the share that faces him and is
// not hidden, times the root of its number of triangles, as modellers spend triangles where there is something to see.
// And how much the surface turns and steps back between neighbouring rays, as scans have triangles of one size.
double visible_detail(const CoarseGrid& grid, const UpFrame& frame, Vec3d towards_viewer);

// The azimuth, in degrees, of the three-quarter view with most of it at that elevation: 30 degrees off one of the four
// sides. Views that show as much as the best, up to a twentieth, count as equal; then the front comes before the sides
// and the back, and the right before the left.
double best_azimuth(const CoarseGrid& grid, const UpFrame& frame, double elevation_deg);

}  // namespace lancer
