// The colours that an EXR file may be written in, and the way between them. Chromaticities: Rec. ITU-R BT.709-6 and
// SMPTE S-2014-004 (ACEScg). Their white points differ, D65 and about D60: as the Academy's transforms do, colours are
// adapted by the matrix of Bradford (Lam, "Metamerism and Colour Constancy", 1985; CIE 159:2004 has its numbers).
#pragma once

#include <array>

#include "core/color.h"
#include "core/enum_names.h"

namespace lancer {

enum class ColorSpace { lin_rec709, acescg };
template <>
inline constexpr auto enum_names<ColorSpace> = std::to_array<std::string_view>({"lin_rec709", "acescg"});

// x and y of red, green, blue and white.
using Chromaticities = std::array<std::array<double, 2>, 4>;
Chromaticities chromaticities_of(ColorSpace space);

using ColorMatrix = std::array<std::array<double, 3>, 3>;  // rows; of column vectors
// From linear Rec. 709 to the space, and back.
ColorMatrix to_space(ColorSpace space);
ColorMatrix from_space(ColorSpace space);

Color transformed(const ColorMatrix& m, Color c);

}  // namespace lancer
