// A statement of a material file that names a texture: "map_Kd -s 2 2 1 -clamp on wood grain.png".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.h"
#include "materials/textures/texture.h"

namespace lancer {

struct MtlMap {
    std::string file;   // '/' between folders; may hold spaces
    std::string whole;  // with what may be a comment behind it; empty: nothing is
    uint32_t line = 0;
    Wrap wrap = Wrap::repeat;
    Vec2 scale{1, 1}, offset{0, 0};
    float gain = 1, base = 0;        // value * gain + base
    float bump = 1;                  // factor on heights
    std::optional<Channel> channel;  // if given
    std::optional<Encoding> encoding;
};

// Parses the arguments of a map statement. Options without effect here are ignored; unsupported ones give a warning.
// Nothing, with a warning, if no file is named.
std::optional<MtlMap> parse_mtl_map(std::string_view arguments, std::string_view key, const Location& where,
                                    Diagnostics& diagnostics);

}  // namespace lancer
