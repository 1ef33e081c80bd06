// A picture as its file stores it, but for the alpha in its colours; the input of textures. io/ fills it, and the scene
// makes a texture of it once its use (colour or data, which channel) is known.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/srgb.h"

namespace lancer {

struct Raster {
    uint32_t width = 0, height = 0;  // pixels, > 0
    uint32_t channels = 0;           // 1: grey, 2: grey and alpha, 3: RGB, 4: RGBA; colours not multiplied by alpha
    // Rows from the top, channels interleaved. One of the two is filled: integers of 8 bits as stored, or anything
    // else as floats (integers of more bits scaled to [0, 1], not decoded).
    std::vector<uint8_t> bytes;
    std::vector<float> floats;
    bool is_float = false;  // the file held floats: linear, whatever they are used for
    float exponent = 0;     // of integers: the power by which the file wants colours decoded; 0: it does not say
    std::string damage{};   // what the decoder had to guess at; empty: nothing

    bool has_alpha() const { return channels == 2 || channels == 4; }
    size_t value_count() const { return size_t{width} * height * channels; }
};

// What the header of a file says of its raster, before anything is allocated for its pixels.
struct RasterHeader {
    // bytes take one byte in memory, all else four; halves: floats that 16 bits hold exactly.
    enum class Values : uint8_t { bytes, integers, halves, floats };

    uint32_t width = 0, height = 0, channels = 0;  // as in Raster
    Values values = Values::bytes;
    float exponent = 0;          // as in Raster
    uint64_t decoder_bytes = 0;  // what reading takes beside the raster

    uint64_t value_count() const { return uint64_t{width} * height * channels; }
    uint64_t bytes() const { return value_count() * (values == Values::bytes ? 1 : sizeof(float)); }
    bool is_float() const { return values == Values::halves || values == Values::floats; }
};

// Undoes the multiplication of colours by alpha ("associated" or premultiplied alpha). Bytes are rounded to the nearest
// step. A colour where alpha is 0 or not finite is left alone: light without a surface.
void divide_by_alpha(Raster& raster);

// Linear values of a raster: integers are decoded by `encoding`, floats are taken as they are. The raster must outlive
// it.
class LinearValues {
public:
    LinearValues(const Raster& raster, Encoding encoding);
    float operator[](size_t i) const;  // i < raster.value_count()

private:
    const Raster& raster_;
    std::vector<float> table_;  // of the integers; those of more than 16 bits are rounded to 65536 steps
};

// Linear RGB: integers decoded as `encoding` says, floats as they stand; alpha is dropped, grey becomes RGB.
Image to_image(const Raster& raster, Encoding encoding);

// Whether it looks like normals in tangent space, encoded in [0, 1]: nearly all texels are of unit length, and most
// point outwards. Grey pictures are heights.
bool looks_like_normals(const Raster& raster);

// A picture that is being read. get() throws Error if it could not be read.
using RasterFuture = std::shared_future<std::shared_ptr<const Raster>>;
// Requests the picture of a file; each file is read once.
using RasterSource = std::function<RasterFuture(const std::string& file)>;

}  // namespace lancer
