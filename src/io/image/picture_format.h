// The formats that pictures are written in.
#pragma once

#include "core/enum_names.h"

namespace lancer {

enum class PictureFormat { exr, png, ppm, jpg, hdr };
template <>
inline constexpr auto enum_names<PictureFormat> = std::to_array<std::string_view>({"exr", "png", "ppm", "jpg", "hdr"});

// Whether pixels become code values, by exposure and tone map. The others hold the light itself.
constexpr bool is_for_displays(PictureFormat format)
{
    return format != PictureFormat::exr && format != PictureFormat::hdr;
}

}  // namespace lancer
