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
    std::string file;  // '/' between folders; may hold spaces
    uint32_t line = 0;
    Wrap wrap = Wrap::repeat;
    Vec2 scale{1, 1}, offset{0, 0};
    float gain = 1, base = 0;        // value * gain + base
    float bump = 1;                  // factor on heights
    std::optional<Channel> channel;  // if said
    std::optional<Encoding> encoding;
};

// arguments: what follows the key. Options that change nothing here are passed over; those that ask for something that
// is not supported become a warning. Nothing if no file is named, with a warning too.
std::optional<MtlMap> parse_mtl_map(std::string_view arguments, std::string_view key, const Location& where,
                                    Diagnostics& diagnostics);

}  // namespace lancer
