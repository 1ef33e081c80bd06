// Whether a subject is a flat sheet, and which way it faces.
#pragma once

#include <optional>

#include "scene/view/coarse_grid.h"
#include "scene/view/up_frame.h"

namespace lancer {

// The direction, unit, that a flat subject faces: nearly all of its surface is perpendicular to it, and along it the
// subject is thinner than a hundredth of its longest side. Of a sheet with two faces the one towards the front, the
// right or upwards.
std::optional<Vec3d> sheet_normal(const Subject& subject, const CoarseGrid& grid, const UpFrame& frame);

}  // namespace lancer
