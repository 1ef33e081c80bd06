// What the scene that names a mesh file says about reading it.
#pragma once

namespace lancer {

class AssetFolder;

struct MeshOptions {
    const AssetFolder* assets = nullptr;  // material files and textures must lie in it; null: anywhere
    bool uvs = false;                     // keep texture coordinates even if no material of the file reads a texture
};

}  // namespace lancer
