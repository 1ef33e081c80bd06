// How the hand moves a camera: each function returns the moved one. Units are those of the scene file.
#pragma once

#include <string>

#include "scene/description/description.h"

namespace lancer {

bool is_same_view(const CameraDescription& a, const CameraDescription& b);

// Right, up and forward of a camera, unit. What is up in the picture need not be camera.up.
struct ViewAxes {
    Vec3d right, up, forward;
};
ViewAxes axes_of(const CameraDescription& camera);

// Around the target, about camera.up and up to 89 degrees above or below it. Positive: the camera goes right, up.
CameraDescription orbited(CameraDescription camera, double right_rad, double up_rad);
// The same in place: the target moves.
CameraDescription turned(CameraDescription camera, double right_rad, double up_rad);
// With its target, by parts of the picture's height at the distance of the target.
CameraDescription panned(CameraDescription camera, double right, double up);
// The distance to the target is multiplied, factor > 0.
CameraDescription dollied(CameraDescription camera, double factor);
// With its target, along its axes.
CameraDescription flown(CameraDescription camera, Vec3d right_up_forward);
// At the same distance from the target, looking along `forward`.
CameraDescription seen_along(CameraDescription camera, Vec3d forward);
// The same direction and distance, with another target.
CameraDescription centred(CameraDescription camera, Vec3d target);
// A point moved in the plane of the picture, by parts of the picture's height.
Vec3d moved_in_view(const CameraDescription& camera, Vec3d point, double right, double up);
// A point moved along the view direction, by a part of its depth.
Vec3d moved_along_view(const CameraDescription& camera, Vec3d point, double part);
// The distance of a point along the view direction.
double depth_of(const CameraDescription& camera, Vec3d point);

// The table [camera] of a scene file; what is read back has the same bits. name: of [camera.NAME], or empty.
std::string camera_table(const CameraDescription& camera, const std::string& name = "");

}  // namespace lancer
