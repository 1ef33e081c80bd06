#include "harness/record.h"

#include <algorithm>
#include <numeric>

#include "render/specialize.h"

namespace lancer::bench {
namespace {

constexpr size_t most_rays = 8'000'000;  // of 40 bytes

class Recorder final : public Accelerator {
public:
    // counters: those of the kernel that asks.
    Recorder(const Accelerator& accel, const Counters& counters) : accel_(accel), counters_(counters) {}

    Hit closest(const Ray& ray) const override
    {
        note({&ray, 1}, false, Coherence::incoherent);
        return accel_.closest(ray);
    }
    bool any(const Ray& ray) const override
    {
        note({&ray, 1}, true, Coherence::incoherent);
        return accel_.any(ray);
    }
    // The kernel traces camera rays as coherent ones and all others as incoherent: a batch of camera rays begins anew.
    // Rays of one depth may come in several calls; between two depths it counts bounces.
    void closest(std::span<const Ray> rays, std::span<Hit> hits, Coherence coherence) const override
    {
        if (coherence == Coherence::coherent)
            depth_ = 0;
        else if (depth_ == 0 || counters_.bounce_rays != counted_)
            ++depth_;
        counted_ = counters_.bounce_rays;
        note(rays, false, coherence);
        accel_.closest(rays, hits, coherence);
    }
    void any(std::span<const Ray> rays, std::span<uint8_t> occluded) const override
    {
        note(rays, true, Coherence::incoherent);
        accel_.any(rays, occluded);
    }
    AccelStats stats() const override { return accel_.stats(); }

    const Recording& recording() const { return recording_; }
    Recording take() { return std::move(recording_); }

private:
    void note(std::span<const Ray> rays, bool occlusion, Coherence coherence) const
    {
        const size_t first = recording_.rays.size();
        std::copy_if(rays.begin(), rays.end(), std::back_inserter(recording_.rays),
                     [](const Ray& r) { return is_traceable(r); });
        const size_t count = recording_.rays.size() - first;
        if (count) recording_.batches.push_back({occlusion, coherence, depth_, first, count});
    }

    const Accelerator& accel_;
    const Counters& counters_;
    mutable Recording recording_;
    mutable uint32_t depth_ = 0;
    mutable uint64_t counted_ = 0;  // bounces, when the last depth began
};

// Strides that are coprime with the number of tiles come by all of them, far from each other.
std::vector<Tile> scattered_tiles(const Stage& stage)
{
    const std::vector<Tile> tiles = stage.tiles();
    size_t stride = std::max<size_t>(1, static_cast<size_t>(0.618 * static_cast<double>(tiles.size())));
    while (std::gcd(stride, tiles.size()) != 1) ++stride;
    std::vector<Tile> scattered;
    for (size_t i = 0; i < tiles.size(); ++i) scattered.push_back(tiles[i * stride % tiles.size()]);
    return scattered;
}

std::vector<Ray> rays_of(const Recording& from, size_t count, bool occlusion, uint32_t depth)
{
    std::vector<Ray> rays;
    for (const Recording::Batch& b : from.batches) {
        if (b.occlusion != occlusion || b.depth != depth) continue;
        const auto first = from.rays.begin() + static_cast<std::ptrdiff_t>(b.first);
        const size_t n = std::min(b.count, count - rays.size());
        rays.insert(rays.end(), first, first + static_cast<std::ptrdiff_t>(n));
    }
    return rays;
}

}  // namespace

Recording record(const Stage& stage, const AnyIntegrator& integrator, std::span<const Tile> tiles, uint32_t spp,
                 const std::function<bool(const Recording&)>& enough)
{
    Counters counters;
    Recorder recorder(stage.renderer.accelerator(), counters);
    const TileKernel kernel = make_tile_kernel(stage.scene, recorder, integrator, stage.config.kernel,
                                               choose_kernel(stage.scene, integrator, stage.config.kernel.profile));
    Film film = stage.film();
    const auto known = stage.renderer.plan(stage.camera, film.width, film.height);
    const SamplingPlan& plan = *known;
    Workspace workspace;
    for (const Tile& tile : tiles) {
        kernel(plan, stage.camera, film, tile, {0, spp}, workspace, counters);
        if (enough && enough(recorder.recording())) break;
    }
    return recorder.take();
}

std::vector<RaySet> record_kinds(const Stage& stage, size_t count)
{
    const std::vector<Tile> tiles = scattered_tiles(stage);
    const auto traced = [&](const AnyIntegrator& integrator, bool occlusion, uint32_t depth) {
        return record(stage, integrator, tiles, samples_per_block, [&](const Recording& r) {
            if (r.rays.size() > most_rays) return true;  // there are few of them
            size_t so_far = 0;
            for (const Recording::Batch& b : r.batches)
                if (b.occlusion == occlusion && b.depth == depth) so_far += b.count;
            return so_far >= count;
        });
    };
    const Recording path = traced(Path{}, false, 2), ao = traced(AmbientOcclusion{}, true, 0);
    std::vector<RaySet> sets;
    const auto add = [&](std::string_view kind, const Recording& from, bool occlusion, uint32_t depth) {
        RaySet set{kind, occlusion, !occlusion && depth == 0 ? Coherence::coherent : Coherence::incoherent,
                   rays_of(from, count, occlusion, depth)};
        if (!set.rays.empty()) sets.push_back(std::move(set));
    };
    add(ray_kinds[0], path, false, 0);
    add(ray_kinds[1], path, true, 0);
    add(ray_kinds[2], ao, true, 0);
    add(ray_kinds[3], path, false, 1);
    add(ray_kinds[4], path, false, 2);
    return sets;
}

}  // namespace lancer::bench
