// Rays asked for as the kernel does: many at once.
#pragma once

#include <algorithm>
#include <span>

#include "core/ray.h"

namespace lancer {

inline constexpr size_t rays_of_batch = 256;

// f(rays, their part of out), batch by batch.
template <class Out, class F>
void in_batches(std::span<const Ray> rays, std::span<Out> out, const F& f)
{
    for (size_t i = 0; i < rays.size(); i += rays_of_batch) {
        const size_t n = std::min(rays_of_batch, rays.size() - i);
        f(rays.subspan(i, n), out.subspan(i, n));
    }
}

}  // namespace lancer
