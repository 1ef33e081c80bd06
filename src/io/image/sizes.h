// Sizes of pictures by the first bytes of their files, for formats whose decoders make room for the pixels as soon as
// they open a file. A file can say anything: nothing is allocated before the size is known and allowed.
#pragma once

#include "core/raster.h"
#include "io/input_file.h"

namespace lancer {

// Each throws Error (invalid_input) for what is not of its format. Their decoders hold a second copy of the pixels.

// The first picture of an animation; always with alpha.
RasterHeader read_gif_size(InputFile& file);
// The first picture of an animation.
RasterHeader read_webp_size(InputFile& file);
// Refused are cube maps, volumes, a file too short for its size, and what makes OpenImageIO's decoder divide by zero:
// colours multiplied by alpha (DXT2, DXT4), and pixels whose bits are not where they can be.
RasterHeader read_dds_size(InputFile& file);
// Grey, or RGB whatever is stored. Reading needs the whole file in memory.
RasterHeader read_jpeg_size(InputFile& file);

}  // namespace lancer
