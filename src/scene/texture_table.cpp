#include "scene/texture_table.h"

#include "core/names.h"
#include "core/parallel.h"

namespace lancer {

void receive_textures(Scene& scene, Diagnostics& diagnostics)
{
    std::vector<std::string> problems(scene.pending.size());
    parallel_for(scene.pending.size(), [&](size_t i) {
        const Scene::Pending& p = scene.pending[i];
        try {
            if (!p.image.valid()) throw Error(ErrorKind::failed, "nothing reads pictures here");
            scene.textures[p.texture] = ImageTexture(*p.image.get(), p.what.use);
        } catch (const Error& e) {
            problems[i] = e.what();
        }
    });
    for (size_t i = 0; i < problems.size(); ++i) {
        if (problems[i].empty()) continue;
        const uint32_t broken = scene.pending[i].texture;
        for (MaterialTraits& traits : scene.traits) {
            if (traits.bump == broken) traits.bump = no_texture;
            if (traits.normal_map == broken) traits.normal_map = no_texture;
        }
        diagnostics.warning(scene.pending[i].what.where, "texture not used: " + problems[i]);
    }
    scene.pending.clear();
}

}  // namespace lancer
