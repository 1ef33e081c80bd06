// A picture file of any format: its raster is what its header promised.
#pragma once

#include <optional>

#include "core/raster.h"
#include "fuzz/input.h"

namespace lancer::fuzz {

// read_header gives a RasterHeader, read a Raster, both of a file.
template <class ReadHeader, class Read>
void try_picture(const std::string& path, const ReadHeader& read_header, const Read& read)
{
    std::optional<RasterHeader> header;
    reads([&] { header = read_header(path); });
    // A picture of a few bytes may be large. Most of the time would go into clearing memory.
    constexpr uint64_t most_values = 1 << 16;
    if (header && header->value_count() > most_values) return;
    reads([&] {
        const Raster raster = read(path);
        require(header && raster.width == header->width && raster.height == header->height &&
                raster.channels == header->channels && raster.is_float == header->is_float());
        require(raster.bytes.size() + raster.floats.size() == raster.value_count());
        to_image(raster, Encoding::of_file);
    });
}

}  // namespace lancer::fuzz
