// What the window shows of a film: its light, or what is known of it.
#pragma once

#include "core/enum_names.h"
#include "core/film.h"
#include "core/image.h"
#include "scene/placement.h"

namespace lancer {

enum class ShownAs { light, noise, samples, albedo, normal, depth };
template <>
inline constexpr auto enum_names<ShownAs> = std::to_array<std::string_view>({"light", "noise", "samples", "albedo",
                                                                             "normal", "depth"});

// The sums that a film must keep for it.
AovLayout layout_of(ShownAs what);

// As a picture. noise: the relative standard error of the mean's luminance, as for independent samples; samples: their
// number over `most`; normal: from [-1, 1] to [0, 1]; depth: over the largest one of the picture.
Image shown_image(const Film& film, ShownAs what, const Normalisation& normalisation, uint32_t most);

}  // namespace lancer
