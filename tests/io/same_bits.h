// Whether two pictures have the same pixels, bit for bit, within the same windows.
#pragma once

#include <cstring>

#include "core/image.h"

namespace lancer {

inline bool same_bits(const Image& a, const Image& b)
{
    return a.display == b.display && a.data == b.data && a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(Color)) == 0;
}

}  // namespace lancer
