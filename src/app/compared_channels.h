// What lancer compare says of the further channels of two EXR pictures: AOVs, layers, variance.
#pragma once

#include <string>

namespace lancer {

// Prints "differing_channels   2 of 14: depth.Z 31, normal.X 2", the last numbers being pixels, for the channels that
// either of two EXR files has besides R, G and B. Values differ if their bits do; all NaNs are alike. A channel that
// one file lacks differs in all pixels. Prints nothing if neither file has further channels, or if one is no EXR.
// Throws as read_exr_info() and read_exr_channel().
void print_differing_channels(const std::string& path, const std::string& reference);

}  // namespace lancer
