// The compiled variants of the kernel. A specialised variant is faster and computes the same bits.
#pragma once

#include <array>
#include <string_view>

namespace lancer {

enum class Profile {
    wide,  // eight paths at a time, see scene/wide_scene.h; of the integrator `path`
    all,   // all scenes and integrators
};
inline constexpr std::array<std::string_view, 2> profile_names{"wide", "all"};
inline std::string_view name_of(Profile p) { return profile_names[static_cast<size_t>(p)]; }

}  // namespace lancer
