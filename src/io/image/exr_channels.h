// Which channels of an OpenEXR file are the picture. Files hold them under any name, in layers ("diffuse.R") and in
// parts; the names are those of the format's documentation, "Technical Introduction to OpenEXR", section on channel
// names, where these say enough.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace lancer {

struct ExrChannels {
    size_t part = 0;
    // One: grey. Three: red, green, blue; an empty name is 0.
    std::vector<std::string> colors;
    std::string alpha{};  // of the same layer; empty: none
};

// parts: of each part the names of its channels; of one that cannot be read none. Taken is, of the layers of a part
// (the names up to the last dot, or without one), the first of the best kind: R, G, B; else Y; else up to three
// channels of any names. Among layers of a kind the one without a name comes first, then those called "combined",
// "beauty" or "rgba" in any case, then the order of the file; the first part before others. Letters may be small.
// Nothing if there are only layers of more channels, or luminance with chroma.
std::optional<ExrChannels> choose_exr_channels(const std::vector<std::vector<std::string>>& parts);

}  // namespace lancer
