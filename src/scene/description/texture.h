// What a scene file says of a texture.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/color.h"
#include "core/error.h"
#include "materials/textures/texture.h"

namespace lancer {

enum class TextureType { image, checker, grid, rim, waves };

// A texture as it is used in one place.
struct TextureDescription {
    Location where;
    TextureType type = TextureType::image;
    std::string file;               // image: path as found on disk
    bool may_be_normals = false;    // image: named as heights by a program that writes maps of normals so
    ImageUse use;                   // image; scale and offset also of the others but rim
    Color even{1, 1, 1}, odd{};     // checker
    Color band{1, 1, 1}, ground{};  // grid
    float band_width = 0.05f;       // grid, rim; in [0, 1]
    std::vector<Wave> waves{};      // waves

    // Whether both make the same texture.
    friend bool operator==(const TextureDescription& a, const TextureDescription& b)
    {
        return a.type == b.type && a.file == b.file && a.may_be_normals == b.may_be_normals && a.use == b.use &&
               a.even == b.even && a.odd == b.odd && a.band == b.band && a.ground == b.ground &&
               a.band_width == b.band_width && a.waves == b.waves;
    }
};
using TextureUse = std::optional<TextureDescription>;

}  // namespace lancer
