// The list of materials. A new one is a header and a word here; the laws in tests/materials pick it up unasked.
// A material is parameters; at a hit it becomes a BSDF, a small value with everything looked up.
#pragma once

#include <variant>

#include "materials/glass.h"
#include "materials/lambert.h"
#include "materials/mirror.h"

namespace lancer {

using Material = std::variant<Lambert, Mirror, Glass>;

// Radiance that a surface sends out by itself.
struct Emission {
    Color radiance;
    bool both_sides = false;  // else only from the side of the geometric normal

    // Towards a point on the front or back side.
    Color towards(bool front) const { return front || both_sides ? radiance : Color{}; }
};

}  // namespace lancer
