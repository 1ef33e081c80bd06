// What the scene that names a mesh file says about reading it.
#pragma once

#include <vector>

#include "core/raster.h"
#include "io/smoothing.h"

namespace lancer {

class AssetFolder;
struct SharedMesh;

struct MeshOptions {
    const AssetFolder* assets = nullptr;  // material files and textures must lie in it; null: anywhere
    RasterSource pictures = {};           // asked for each texture as soon as it is known; may be empty
    size_t parallel_from =
        size_t{32} << 20;  // bytes of a file from which on all threads parse it, in parts of so many:
    size_t chunk = size_t{1} << 18;
    bool uvs = false;  // keep texture coordinates even if no material of the file reads a texture
    Smoothing smoothing = {};
    // Not null: takes what the file places several times, for instances, instead of copies in the mesh. Where that is
    // all there is, the mesh is the first of these.
    std::vector<SharedMesh>* shared = nullptr;
};

}  // namespace lancer
