// What the frames of a film leave to each other, so that what does not change is read and built once. A film holds one;
// a single picture has none.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/asset_files.h"
#include "app/defaults/complete_scene.h"
#include "io/image/source.h"
#include "io/scene/scene_file.h"
#include "render/renderer.h"

namespace lancer {

struct FrameCache {
    bool skips_finished = true;  // frames whose pictures are there are not drawn again

    std::shared_ptr<ImageSource> images;
    std::map<std::string, RasterFuture> pictures;  // so that none is read twice
    std::map<std::string, std::shared_ptr<const MeshData>> meshes;
    FileHashes hashes;
    // Of a film whose camera alone turns: the scene before it does.
    std::optional<std::pair<SceneDescription, Completed>> unturned;

    std::shared_ptr<const Renderer> renderer;  // of the last frame that was drawn; null: none yet
    uint64_t still_hash = 0;                   // SceneDescription::still_hash of its scene
    std::string added;                         // Completed::text

    // The loader, asked once for each file and way of reading it.
    MeshLoader once(MeshLoader loader);
    // The source, with all that it was asked for held.
    RasterSource held(RasterSource source);
};

}  // namespace lancer
