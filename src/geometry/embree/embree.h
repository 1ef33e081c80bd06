// Embree behind the seam: triangle meshes, one level of instances, spheres and planes as user geometry.
#pragma once

#include <memory>
#include <string>

#include "geometry/accel.h"

namespace lancer {

// Scenes are built robust: the fast mode loses up to a quarter of the rays far from the origin.
std::unique_ptr<Accelerator> make_embree(const Geometry& geometry, const std::string& isa);

// "3.13.5", of the library that is loaded.
std::string embree_version();

}  // namespace lancer
