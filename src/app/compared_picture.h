// The pictures that lancer compare looks at, and what they say of how they came to be.
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
    bool is_float = false;  // else its file holds integers, made for a screen
    Metadata metadata;      // of EXR and PNG pictures of lancer

    // Of each pixel's mean luminance: the channel variance.V, where there is one that says something.
    std::optional<std::vector<float>> variance;
    std::string no_variance;  // else why, as the end of a sentence
    double rounding = 0;      // a value may be off by this part of itself

    // What the picture says under this name; nothing if it does not.
    std::optional<std::string> said(const std::string& name) const;
};

// Throws as read_image.
ComparedPicture read_compared(const std::string& path);

// The seed of both, if they have the same: then they are made of the same random numbers, so that the difference shows
// less noise than there is.
std::optional<std::string> shared_seed(const ComparedPicture& a, const ComparedPicture& b);

}  // namespace lancer
