// Embree as an Accelerator: triangle meshes, one level of instances, spheres and planes as user geometry.
#pragma once

#include <memory>
#include <string>

#include "geometry/accel.h"

namespace lancer {

// Scenes are built with RTC_SCENE_FLAG_ROBUST: the fast mode loses up to a quarter of the rays far from the origin.
std::unique_ptr<Accelerator> make_embree(const Geometry& geometry, const std::string& isa);

// Version of the loaded library: "3.13.5".
std::string embree_version();

}  // namespace lancer
