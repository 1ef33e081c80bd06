// Into which layers the light of a picture can be divided.
#pragma once

#include <cstdint>

namespace lancer {

// Segments of a path, by which a picture can be split into parts of the light. Only `view` and `direct` see emitters
// directly.
enum class PathSegment : uint8_t {
    view,      // from the camera, continued by mirrors and smooth glass
    direct,    // the ray from the first diffuse or rough surface
    indirect,  // all later rays
};
inline constexpr uint32_t path_segments = 3;

// Into which layers the light of a picture is divided: by the groups of lights that it comes from, and by the segment
// of the path at whose end it was found. Each of the two adds up to the picture.
struct LayerLayout {
    uint32_t groups = 0;  // 0: not divided by them
    bool has_segments = false;

    // Number of layers: the groups first.
    constexpr uint32_t size() const { return groups + (has_segments ? path_segments : 0); }
};

}  // namespace lancer
