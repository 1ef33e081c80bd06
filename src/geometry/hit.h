// What a ray met. Everything else about the place is derived later, once, by surface_at().
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
    Kind kind = Kind::none;  // none: the ray left the scene
    bool exit = false;       // sphere: where the ray leaves the ball, not where it enters
    uint32_t leaf_hint = UINT32_MAX;  // where in itself the accelerator found it, for Ray::leaf_hint; or nowhere

    explicit operator bool() const { return kind != Kind::none; }
};

}  // namespace lancer
