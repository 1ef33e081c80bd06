// Pictures that are still being read while a scene is built.
#pragma once

#include <optional>
#include <vector>

#include "scene/description/description.h"

namespace lancer {

struct PendingPictures {
    struct OfTexture {
        uint32_t texture;  // in Scene::textures; it stands for 1 until its picture is there
        TextureDescription what;
        RasterFuture image;
    };
    std::vector<OfTexture> textures;
    struct OfEnvironment {
        LightDescription what;
        RasterFuture image;
    };
    std::optional<OfEnvironment> environment;
    struct OfBackground {
        BackgroundDescription what;
        RasterFuture sky, ground;
    };
    std::optional<OfBackground> background;
};

}  // namespace lancer
