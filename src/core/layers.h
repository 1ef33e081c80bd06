// Into which layers the light of a picture can be divided.
#pragma once

#include <cstdint>

#include "core/color.h"

namespace lancer {

// Segments of a path, by which a picture can be split into parts of the light. Only `view` and `direct` see emitters
// directly.
enum class PathSegment : uint8_t {
    view,      // from the camera, continued by mirrors and smooth glass
    direct,    // the ray from the first diffuse or rough surface
    indirect,  // all later rays
};
inline constexpr uint32_t path_segments = 3;

// Lobes of the first surface of a path, by which a picture can be split as well.
enum class Lobe : uint8_t {
    none,          // the path has met no surface that it left again: the camera sees the light itself
    diffuse,       // Lambertian reflection, also below a coat
    glossy,        // all other reflection: mirrors, metal, coats, highlights, that of glass
    transmission,  // to the other side, bent, straight on or spread
};
inline constexpr uint32_t path_lobes = 4;

// By which lobes a path left its first surface: of each colour channel the part `diffuse`, in [0, 1], by that lobe, the
// rest by another.
struct LobeShare {
    Color diffuse{};
    Lobe rest = Lobe::none;
};

// Into which layers the light of a picture is divided: by the groups of lights that it comes from, by the segment of
// the path at whose end it was found, and by the lobe of the path's first surface. Each of them adds up to the picture.
struct LayerLayout {
    uint32_t groups = 0;  // 0: not divided by them
    bool has_segments = false, has_lobes = false;

    // Number of layers: the groups first, then the segments.
    constexpr uint32_t size() const { return first_lobe() + (has_lobes ? path_lobes : 0); }
    constexpr uint32_t first_lobe() const { return groups + (has_segments ? path_segments : 0); }
};

}  // namespace lancer
