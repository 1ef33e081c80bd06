// What the window shows of a film: its light, or what is known of it.
#pragma once

#include <optional>
#include <stop_token>

#include "core/enum_names.h"
#include "core/film.h"
#include "core/image.h"
#include "scene/placement.h"

namespace lancer {

enum class ShownAs { light, noise, samples, albedo, normal, depth, denoised };
template <>
inline constexpr auto enum_names<ShownAs> = std::to_array<std::string_view>({"light", "noise", "samples", "albedo",
                                                                             "normal", "depth", "denoised"});

// Allocates the sums that a film must keep for it.
void keep_for(ShownAs what, Film& film);

// As a picture. noise: the relative standard error of the mean's luminance, as for independent samples; samples: their
// number over `most`; normal: from [-1, 1] to [0, 1]; depth: over the largest one of the picture; denoised: if the film
// has been given room for it, else light. Denoising takes seconds: it gives nothing if it is stopped. Must be called
// inside with_threads.
std::optional<Image> shown_image(const Film& film, ShownAs what, const Normalisation& normalisation, uint32_t most,
                                 const std::stop_token& stop);

}  // namespace lancer
