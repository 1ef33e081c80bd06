// The compiled variants of the kernel. A specialised variant is faster and computes the same bits.
#pragma once

#include "core/enum_names.h"

namespace lancer {

enum class Profile {
    wide,  // eight paths at a time, see scene/wide_scene.h; of the integrator `path`
    all,   // all scenes and integrators
};
template <>
inline constexpr auto enum_names<Profile> = std::to_array<std::string_view>({"wide", "all"});

}  // namespace lancer
