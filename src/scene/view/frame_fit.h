// Places a camera so that a subject fills the picture.
#pragma once

#include "scene/description/description.h"
#include "scene/view/subject.h"

namespace lancer {

// The camera that looks along -back with its `up` and `fov_deg`, at a distance from which all of the subject is in the
// picture, about in its middle: its bounding box takes 0.93 of the width or height, or a little more where its
// outline would take less than 0.62. position and target are set; with fixed_target the target is kept, and the outline
// may lie off the middle. back: unit, not parallel to up. aspect: width over height.
void fit_to_frame(CameraDescription& camera, const Subject& subject, Vec3d back, double aspect,
                  bool fixed_target = false);

}  // namespace lancer
