// What lancer compare says of the further channels of two EXR pictures: AOVs, layers, variance.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace lancer {

struct DifferingChannels {
    size_t count = 0;                                       // of channels that either file has
    std::vector<std::pair<std::string, size_t>> differing;  // their names, and in how many pixels
};

// Of the channels that either of two EXR files has besides R, G and B; none if one is no EXR. Values differ if their
// bits do; all NaNs are alike. A channel that one file lacks differs in all pixels. Throws as read_exr_info() and
// read_exr_channel().
DifferingChannels differing_channels(const std::string& path, const std::string& reference);

// "differing_channels   2 of 14: depth.Z 31, normal.X 2"; nothing if neither file has further channels.
void print_differing_channels(const DifferingChannels& channels);

}  // namespace lancer
