// A ray in registers, with its numbers as they lie in memory: the fourth lanes hold what comes behind.
#pragma once

#include <cstddef>

#include "core/lanes.h"
#include "core/ray.h"

namespace lancer {

static_assert(offsetof(Ray, t_min) == offsetof(Ray, org) + 12 && offsetof(Ray, t_max) == offsetof(Ray, dir) + 12);

inline Float4 org_and_t_min(const Ray& r) { return load4(&r.org.x); }
inline Float4 dir_and_t_max(const Ray& r) { return load4(&r.dir.x); }

}  // namespace lancer
