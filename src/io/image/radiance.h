// The header of Radiance pictures (.hdr): how the rows lie, and by what the pixels were multiplied. OpenImageIO decodes
// pixels and leaves the rest to its caller. Greg Ward, "Radiance File Formats", and the manual page of getinfo(1).
#pragma once

#include "core/color.h"
#include "core/raster.h"
#include "io/image/metadata.h"
#include "io/input_file.h"

namespace lancer {

struct RadianceHeader {
    // Of the picture as it is meant to be seen.
    uint32_t width = 0, height = 0;
    // The stored rows (or columns) and the pixels in them run so: of the line "-Y height +X width", the usual one, all
    // are false.
    bool columns_first = false, from_right = false, from_bottom = false;
    Color factor{1, 1, 1};  // that gives radiance back: 1 / (EXPOSURE * COLORCORR), each the product of all lines

    Metadata metadata;  // of the lines "lancer:NAME=VALUE"

    bool is_turned() const { return columns_first || from_right || from_bottom; }
    // Whether a decoder that knows rows alone has this size.
    bool fits(int32_t row, int32_t rows) const
    {
        return row == static_cast<int32_t>(columns_first ? height : width) &&
               rows == static_cast<int32_t>(columns_first ? width : height);
    }
};

// Throws Error (invalid_input) where there is no size line or a factor is not above 0, and for pixels in CIE XYZ.
RadianceHeader read_radiance_header(InputFile& file);

// From the pixels as they are stored (rows of the file, three floats each) to the picture.
void apply_radiance_header(const RadianceHeader& header, Raster& raster);

}  // namespace lancer
