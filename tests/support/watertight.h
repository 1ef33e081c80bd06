// Counting the rays that leave a closed mesh through nothing: one by one, in batches, and as shadow rays.
#pragma once

#include <atomic>

#include "core/parallel.h"
#include "geometry/accel.h"
#include "support/rays_at_edges.h"

namespace lancer {

// How rays are asked about; see Accelerator.
enum class Asked { singly, in_batches, any, any_in_batches };
inline constexpr std::array all_asked{Asked::singly, Asked::in_batches, Asked::any, Asked::any_in_batches};
inline constexpr std::string_view name_of(Asked asked)
{
    constexpr std::string_view names[] = {"single", "batch", "any", "any-batch"};
    return names[static_cast<size_t>(asked)];
}

// Of rays first to first + count - 1, on all threads of the parallel loop. Half of the batches are called coherent.
uint64_t count_misses(const Accelerator& accel, const RaysFromInside& rays, Aim aim, Asked asked, uint64_t first,
                      uint64_t count);

}  // namespace lancer
