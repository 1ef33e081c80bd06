// What the scene that names a mesh file says about reading it.
#pragma once

#include "core/raster.h"

namespace lancer {

class AssetFolder;

struct MeshOptions {
    const AssetFolder* assets = nullptr;  // material files and textures must lie in it; null: anywhere
    RasterSource pictures = {};           // asked for each texture as soon as it is known; may be empty
    bool uvs = false;                     // keep texture coordinates even if no material of the file reads a texture
};

}  // namespace lancer
