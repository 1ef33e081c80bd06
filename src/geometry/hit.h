// A ray hit. surface_at() computes everything else from it.
#pragma once

#include <cstdint>

#include "core/vec.h"

namespace lancer {

enum class Kind : uint8_t { none, triangle, sphere, plane };

struct Hit {
    static constexpr uint32_t no_instance = UINT32_MAX;

    float t = 0;
    uint32_t instance = no_instance;
    uint32_t geometry = 0;   // triangle: index of the mesh; else 0
    uint32_t primitive = 0;  // index of the triangle, sphere or plane
    Vec2 uv;                 // triangle: barycentric weights of the second and third corner, in [0, 1], sum <= 1
    Kind kind = Kind::none;  // none: a miss
    bool exit = false;       // sphere: the ray leaves the sphere here
    uint32_t leaf_hint = UINT32_MAX;  // the accelerator's leaf of the hit, for Ray::leaf_hint; or Ray::no_leaf_hint

    explicit operator bool() const { return kind != Kind::none; }
};

}  // namespace lancer
