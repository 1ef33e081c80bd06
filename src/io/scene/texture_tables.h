// The textures of a scene file: [texture.NAME], and the pictures that materials name without one.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/asset_path.h"
#include "io/toml_reader.h"
#include "scene/description/material.h"

namespace lancer {

// The waves at a key: a list of [amplitude, direction, length, phase]; empty if there is none or it is wrong.
std::vector<Wave> read_waves(const TomlTable& table, std::string_view key);

class TextureTables {
public:
    // Reads every [texture.NAME].
    TextureTables(const TomlTable& root, const AssetFolder& assets);

    // The texture at a key: one that stands there as a table, a [texture.NAME], else a picture file.
    TextureUse use(const TomlTable& table, std::string_view key, TextureRole role) const;

private:
    struct Named {
        TextureDescription texture;
        std::optional<Encoding> encoding;  // not said: the role decides
        std::optional<Channel> channel;
    };

    Named read(const TomlTable& table) const;
    // The path of a picture, or nothing and an error.
    std::optional<std::string> find(const TomlTable& table, std::string_view key, const std::string& name) const;

    const AssetFolder& assets_;
    std::map<std::string, Named> named_;
};

}  // namespace lancer
