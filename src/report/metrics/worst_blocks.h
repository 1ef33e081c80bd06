// The blocks of pictures with the largest errors.
#pragma once

#include <cstddef>
#include <vector>

#include "core/image.h"

namespace lancer {

// Up to `count` disjoint blocks of at most side x side pixels, the worst one first. The picture is divided into blocks
// of almost equal size. A block's score is its mean relative squared error divided by that of the whole picture, summed
// over the pictures, so that the noisiest does not dominate; pictures with no error or an infinite one do not count.
// None without pictures. Throws as compare().
std::vector<Window> worst_blocks(const Image& reference, const std::vector<const Image*>& pictures, int32_t side,
                                 size_t count);

// A crop of an image; the image must contain the window.
Image part_of(const Image& image, const Window& window);

}  // namespace lancer
