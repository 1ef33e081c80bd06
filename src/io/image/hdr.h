// Radiance pictures (.hdr): light with 8 bits for each channel and an exponent that the three share. Greg Ward,
// "Real Pixels", Graphics Gems II, and "Radiance File Formats". radiance.h reads their headers.
#pragma once

#include <array>
#include <cstdint>

#include "core/color.h"
#include "io/image/exr.h"
#include "io/image/metadata.h"

namespace lancer {

class AtomicFile;

// Red, green, blue, and the exponent, for which 128 is 0. Values are rounded to the nearest, as most readers take them
// as they stand: the largest channel is off by at most 1/256 of itself. Below 0 and NaN become 0; what is beyond the
// largest number, 2^127 * 255/256, becomes it.
std::array<uint8_t, 4> to_rgbe(Color c);

// Rows of the data window, each packed by run lengths; the primaries are Rec. 709. Each metadata pair is a line
// "lancer:NAME=VALUE" of the header. The owner of the file commits it. Throws Error (failed).
void write_hdr(AtomicFile& file, const ImageRows& image, const Metadata& metadata = {});

}  // namespace lancer
