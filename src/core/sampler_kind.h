// The kinds of random numbers that Sampler gives, with their names.
#pragma once

#include "core/enum_names.h"

namespace lancer {

enum class SamplerKind { sobol, independent };
template <>
inline constexpr auto enum_names<SamplerKind> = std::to_array<std::string_view>({"sobol", "independent"});

}  // namespace lancer
