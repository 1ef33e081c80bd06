// Embree as an Accelerator: triangle meshes, one level of instances, spheres and planes as user geometry.
#pragma once

#include <memory>
#include <string>

#include "geometry/accel.h"

namespace lancer {

// Renders use the robust mode: the fast one, which benchmarks compare, loses up to a quarter of the rays far from the
// origin.
enum class EmbreeMode { robust, fast };
std::unique_ptr<Accelerator> make_embree(const Geometry& geometry, const std::string& isa,
                                         EmbreeMode mode = EmbreeMode::robust);

// Version of the loaded library: "3.13.5".
std::string embree_version();

}  // namespace lancer
