// The accelerators that there are, with their names; and the instruction sets that Embree may be limited to.
#pragma once

#include "core/enum_names.h"

namespace lancer {

// automatic: the one that fastest_accelerator() chooses.
enum class AccelKind { automatic, embree, list, list8, box, median, bvh2, bvh8 };

// All but `automatic`, in the order of AccelKind.
struct AccelName {
    std::string_view name;
    AccelKind kind;
    bool tries_all = false;  // of the triangles, for each ray
};
inline constexpr std::array accelerators{
    AccelName{"embree", AccelKind::embree},     AccelName{"list", AccelKind::list, true},
    AccelName{"list8", AccelKind::list8, true}, AccelName{"box", AccelKind::box, true},
    AccelName{"median", AccelKind::median},     AccelName{"bvh2", AccelKind::bvh2},
    AccelName{"bvh8", AccelKind::bvh8},
};
template <>
inline constexpr auto enum_names<AccelKind> = [] {
    std::array<std::string_view, accelerators.size() + 1> names{"auto"};
    for (const AccelName& a : accelerators) names[static_cast<size_t>(a.kind)] = a.name;
    return names;
}();

enum class Isa { sse2, sse4_2, avx, avx2, avx512 };
template <>
inline constexpr auto enum_names<Isa> = std::to_array<std::string_view>({"sse2", "sse4.2", "avx", "avx2", "avx512"});

}  // namespace lancer
