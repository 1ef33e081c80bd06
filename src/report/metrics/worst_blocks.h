// Where pictures are worst: blocks to look at.
#pragma once

#include <cstddef>
#include <vector>

#include "core/image.h"

namespace lancer {

// Up to `count` blocks of at most side x side pixels that do not overlap, the worst one first. The picture is cut into
// blocks of as equal a size as there is. A block counts by its mean relative squared error over that of the whole
// picture, summed over the pictures: each has the same weight, so that the noisiest does not decide alone; one without
// any error, or with an infinite one, has none. None if there are no pictures. Throws as compare().
std::vector<Window> worst_blocks(const Image& reference, const std::vector<const Image*>& pictures, int32_t side,
                                 size_t count);

// The pixels within a window that the image contains, as an image of their own.
Image part_of(const Image& image, const Window& window);

}  // namespace lancer
