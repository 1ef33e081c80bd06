// The pictures of lancer compare, with their metadata.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "io/image/metadata.h"

namespace lancer {

struct ComparedPicture {
    std::string path;
    Image image;            // linear light
    bool is_float = false;  // false: its file holds integers
    Metadata metadata;      // of pictures of lancer

    // Variance of each pixel's mean luminance: the channel variance.V, if it is usable.
    std::optional<std::vector<float>> variance;
    std::string no_variance;  // the reason if there is none, as the end of a sentence
    double rounding = 0;      // relative rounding error of values

    // The metadata value of this name, if there is one.
    std::optional<std::string> said(const std::string& name) const;
};

// Throws as read_image.
ComparedPicture read_compared(const std::string& path);

// The common seed, if both pictures have the same: then their samples are the same, and the difference shows less noise
// than there is.
std::optional<std::string> shared_seed(const ComparedPicture& a, const ComparedPicture& b);

}  // namespace lancer
