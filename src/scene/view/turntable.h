// A camera that circles a scene.
#pragma once

#include "scene/description/description.h"

namespace lancer {

// The camera turned about the axis through `center` along `up` (unit), by a part of a whole turn, counter-clockwise
// seen from above. Quarters of a turn are exact where the axis is one of the coordinate axes; of 0 nothing changes.
CameraDescription turned(CameraDescription camera, Vec3d center, Vec3d up, double part);

}  // namespace lancer
