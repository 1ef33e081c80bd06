#include "app/bench/bench_scene.h"

#include "app/bench/agreement.h"
#include "core/hash.h"
#include "render/config.h"

namespace lancer {
namespace {

constexpr uint32_t paths_at_once = 256;
constexpr size_t most_looked_at = 2'000'000;  // rays, for the rare ones among them

template <class T>
uint64_t hash_of_items(const std::vector<T>& items, uint64_t so_far)
{
    return hash_bytes({reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T)}, so_far);
}

}  // namespace

BenchScene::BenchScene(const PictureOptions& options)
{
    Diagnostics diagnostics;
    prepared_ = load_prepared(options, diagnostics, true);
    // Found by one accelerator, rays are the same whatever is compared; and every sample of a pixel counts.
    prepared_.settings.accel = AccelKind::embree;
    prepared_.settings.stop = false;
    isa_ = configure(prepared_.settings, paths_at_once).isa;
    begin_prepared(prepared_, diagnostics);
    renderer_ = make_renderer(prepared_, options, paths_at_once, diagnostics);
    const Geometry& g = renderer_->scene().geometry;
    if (drawn_triangles(g) == 0)
        throw Error(ErrorKind::invalid_input, {options.scene.file}, "has no triangles: there is nothing to compare");
    if (g.spheres.empty() && g.planes.empty() && !g.alpha_test.passes_through) return;
    auto bare = std::make_unique<Geometry>();
    bare->meshes = g.meshes, bare->instances = g.instances;
    bare_ = std::move(bare);
}

uint64_t BenchScene::hash() const
{
    uint64_t hash = 0;
    for (const Mesh& m : bare().meshes) hash = hash_of_items(m.triangles, hash_of_items(m.positions, hash));
    for (const Instance& i : bare().instances)
        for (const Vec3d& v : {i.to_world.x, i.to_world.y, i.to_world.z, i.to_world.translation})
            hash = hash_bytes({reinterpret_cast<const char*>(&v), sizeof v}, hash ^ i.mesh);
    return hash;
}

Camera BenchScene::camera(PictureSize size) const
{
    return {*prepared_.description.camera, renderer_->scene().normalisation, size.width, size.height,
            pixel_grid(prepared_.settings)};
}

std::vector<RaySet> BenchScene::rays(size_t count, std::span<const std::string_view> kinds) const
{
    const RendererConfig config = configure(prepared_.settings, paths_at_once);
    const Camera whole = camera(prepared_.settings.size);
    return find_rays({*renderer_, config.kernel, whole, prepared_.settings.size}, count, kinds, most_looked_at);
}

}  // namespace lancer
