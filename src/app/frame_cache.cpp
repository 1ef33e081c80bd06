#include "app/frame_cache.h"

#include "app/console.h"

namespace lancer {

MeshLoader FrameCache::once(MeshLoader loader)
{
    return [this, loader = std::move(loader)](const std::string& path, Diagnostics& diagnostics,
                                              const MeshOptions& options) {
        const Smoothing& smoothing = options.smoothing;
        const std::string key = path + '\n' + std::to_string(static_cast<int>(smoothing.faces)) + ' ' +
                                shortest(smoothing.largest_deg) + (options.uvs ? " uvs" : "");
        std::shared_ptr<const MeshData>& mesh = meshes[key];
        MeshOptions whole = options;
        whole.shared = nullptr;  // they would be missing in the next frame
        if (!mesh) mesh = loader(path, diagnostics, whole);
        return mesh;
    };
}

RasterSource FrameCache::held(RasterSource source)
{
    return [this, source = std::move(source)](const std::string& file) {
        const auto [entry, is_new] = pictures.try_emplace(file);
        if (is_new) entry->second = source(file);
        return entry->second;
    };
}

}  // namespace lancer
