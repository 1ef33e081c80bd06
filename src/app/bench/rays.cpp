#include "app/bench/rays.h"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <random>

#include "app/bench/agreement.h"
#include "app/bench/batches.h"
#include "app/options/options.h"
#include "core/hash.h"
#include "render/specialize.h"

namespace lancer {
namespace {

class RayRecorder final : public Accelerator {
public:
    // counters: those of the kernel that asks.
    RayRecorder(const Accelerator& accel, const Counters& counters) : accel_(accel), counters_(counters) {}

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

    const RayRecording& recording() const { return recording_; }
    RayRecording take() { return std::move(recording_); }

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
    mutable RayRecording recording_;
    mutable uint32_t depth_ = 0;
    mutable uint64_t counted_ = 0;  // bounces, when the last depth began
};

// Strides that are coprime with the number of tiles come by all of them, far from each other.
std::vector<Tile> scattered(const std::vector<Tile>& tiles)
{
    size_t stride = std::max<size_t>(1, static_cast<size_t>(0.618 * static_cast<double>(tiles.size())));
    while (std::gcd(stride, tiles.size()) != 1) ++stride;
    std::vector<Tile> scattered;
    for (size_t i = 0; i < tiles.size(); ++i) scattered.push_back(tiles[i * stride % tiles.size()]);
    return scattered;
}

// Of few tiles all might show the sky.
constexpr size_t least_tiles = 100;

// The rays of a kind in a recording: as it calls them.
struct RecordedKind {
    std::string_view kind;
    bool occlusion;
    uint32_t depth;

    bool has(const RayRecording::Batch& b) const { return b.occlusion == occlusion && b.depth == depth; }
};
constexpr std::array path_kinds{RecordedKind{"primary", false, 0}, RecordedKind{"shadow", true, 0},
                                RecordedKind{"bounce1", false, 1}, RecordedKind{"bounce2", false, 2},
                                RecordedKind{"bounce3", false, 3}};
constexpr std::array ao_kinds{RecordedKind{"ao", true, 0}};

// From batches all over the recording, in its order.
RaySet set_of(const RayRecording& from, const RecordedKind& kind, size_t count)
{
    const bool coherent = !kind.occlusion && kind.depth == 0;
    RaySet set{kind.kind, kind.occlusion, coherent ? Coherence::coherent : Coherence::incoherent, {}};
    size_t all = 0, passed = 0;
    for (const RayRecording::Batch& b : from.batches) all += kind.has(b) ? b.count : 0;
    const double part = std::min(1.0, static_cast<double>(count) / static_cast<double>(std::max<size_t>(1, all)));
    for (const RayRecording::Batch& b : from.batches) {
        if (!kind.has(b)) continue;
        passed += b.count;
        // A batch that brings the set up to its part of what has gone by.
        if (static_cast<double>(set.rays.size() + b.count) > part * static_cast<double>(passed) + 0.5 * double(b.count))
            continue;
        const auto first = from.rays.begin() + static_cast<std::ptrdiff_t>(b.first);
        const size_t n = std::min(b.count, count - set.rays.size());
        set.rays.insert(set.rays.end(), first, first + static_cast<std::ptrdiff_t>(n));
    }
    return set;
}

// Where most of the triangles are: a ground that reaches far is left out.
Bounds box_of_most(const Geometry& g)
{
    constexpr size_t looked_at = 4096;
    std::array<std::vector<double>, 3> at;
    const auto look = [&](const Mesh& m, size_t all, const auto& place) {
        const size_t step = std::max<size_t>(1, all / looked_at);
        for (size_t i = 0; i < m.triangles.size(); i += step) {
            const Vec3d p = place(to_double(m.positions[m.triangles[i][0]]));
            at[0].push_back(p.x), at[1].push_back(p.y), at[2].push_back(p.z);
        }
    };
    const size_t all = drawn_triangles(g);
    for (const Mesh& m : g.meshes)
        if (!m.instanced) look(m, all, [](Vec3d p) { return p; });
    for (const Instance& i : g.instances) look(g.meshes[i.mesh], all, [&](Vec3d p) { return i.to_world.point(p); });
    if (at[0].empty()) return {};
    const auto ends = [](std::vector<double>& values) {
        std::sort(values.begin(), values.end());
        const size_t cut = values.size() / 100;
        return std::pair(values[cut], values[values.size() - 1 - cut]);
    };
    const auto x = ends(at[0]), y = ends(at[1]), z = ends(at[2]);
    Bounds box;
    box.grow(Vec3d{x.first, y.first, z.first});
    box.grow(Vec3d{x.second, y.second, z.second});
    return box;
}

// Rays anywhere in the box, in any direction: what no order helps.
RaySet random_rays(const Bounds& box, size_t count)
{
    std::mt19937_64 bits(1);
    const auto uniform = [&] { return static_cast<double>(bits() >> 11) * 0x1p-53; };
    RaySet set{"random", false, Coherence::incoherent, {}};
    while (set.rays.size() < count) {
        const double x = uniform(), y = uniform(), w = uniform();
        const Vec3d size = box.upper - box.lower;
        const Vec3d org = box.lower + Vec3d{x * size.x, y * size.y, w * size.z};
        const double z = 2 * uniform() - 1, turn = 2 * std::numbers::pi * uniform(), r = std::sqrt(1 - z * z);
        Ray ray;
        ray.org = to_float(org), ray.dir = to_float(Vec3d{r * std::cos(turn), r * std::sin(turn), z});
        if (is_traceable(ray)) set.rays.push_back(ray);
    }
    return set;
}

}  // namespace

std::vector<Tile> RaySource::tiles() const { return make_tiles(whole(), RenderOptions{}.tile); }

RayRecording record_rays(const RaySource& source, const AnyIntegrator& integrator, std::span<const Tile> tiles,
                         uint32_t spp, const std::function<bool(const RayRecording&)>& enough)
{
    const Scene& scene = source.renderer.scene();
    Counters counters;
    RayRecorder recorder(source.renderer.accelerator(), counters);
    const TileKernel kernel = make_tile_kernel(scene, recorder, integrator, source.kernel,
                                               choose_kernel(scene, integrator, source.kernel.profile));
    Film film(source.size.width, source.size.height, source.whole());
    const auto known = source.renderer.plan(source.camera, film.width, film.height);
    const SamplingPlan& plan = *known;
    Workspace workspace;
    for (const Tile& tile : tiles) {
        kernel(plan, source.camera, film, tile, {0, spp}, workspace, counters);
        if (enough && enough(recorder.recording())) break;
    }
    return recorder.take();
}

std::vector<RaySet> find_rays(const RaySource& source, size_t count, std::span<const std::string_view> kinds,
                              size_t most)
{
    const auto is_wanted = [&](std::string_view kind) {
        return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
    };
    const std::vector<Tile> tiles = scattered(source.tiles());
    std::vector<RaySet> sets;
    const auto take = [&](const AnyIntegrator& integrator, std::span<const RecordedKind> recorded) {
        const RecordedKind* last = nullptr;  // the rarest
        for (const RecordedKind& kind : recorded)
            if (is_wanted(kind.kind)) last = &kind;
        if (!last) return;
        size_t seen = 0;
        const RayRecording recording =
            record_rays(source, integrator, tiles, samples_per_block, [&](const RayRecording& r) {
                if (r.rays.size() > most) return true;
                if (++seen < least_tiles) return false;
                size_t so_far = 0;
                for (const RayRecording::Batch& b : r.batches) so_far += last->has(b) ? b.count : 0;
                return so_far >= count;
            });
        for (const RecordedKind& kind : recorded)
            if (is_wanted(kind.kind)) sets.push_back(set_of(recording, kind, count));
    };
    take(Path{}, path_kinds);
    take(AmbientOcclusion{}, ao_kinds);
    if (is_wanted("random"))
        if (const Bounds box = box_of_most(source.renderer.scene().geometry); !box.empty())
            sets.push_back(random_rays(box, count));
    std::erase_if(sets, [](const RaySet& set) { return set.rays.empty(); });
    const auto place = [](const RaySet& set) {
        return std::find(ray_set_kinds.begin(), ray_set_kinds.end(), set.kind) - ray_set_kinds.begin();
    };
    std::sort(sets.begin(), sets.end(), [&](const RaySet& a, const RaySet& b) { return place(a) < place(b); });
    return sets;
}

void deal(RaySet& set)
{
    // Multiples of the golden ratio, without their whole part, are even over any stretch of neighbours; a stride would
    // meet the same place in each tile of the picture.
    const size_t batches = (set.rays.size() + rays_of_batch - 1) / rays_of_batch;
    const auto place = [](size_t b) { return std::fmod(static_cast<double>(b) * std::numbers::phi, 1.0); };
    std::vector<size_t> order(batches);
    std::iota(order.begin(), order.end(), size_t{0});
    std::sort(order.begin(), order.end(), [&](size_t x, size_t y) { return place(x) < place(y); });
    std::vector<Ray> dealt;
    dealt.reserve(set.rays.size());
    for (const size_t b : order) {
        const size_t first = b * rays_of_batch, n = std::min(rays_of_batch, set.rays.size() - first);
        const auto begin = set.rays.begin() + static_cast<std::ptrdiff_t>(first);
        dealt.insert(dealt.end(), begin, begin + static_cast<std::ptrdiff_t>(n));
    }
    set.rays = std::move(dealt);
}

uint64_t hash_of(const RaySet& set)
{
    // Field by field, as a leaf hint is of the accelerator that found the ray.
    uint64_t hash = hash_bytes(set.kind);
    for (const Ray& r : set.rays) {
        const std::array<float, 8> numbers{r.org.x, r.org.y, r.org.z, r.t_min, r.dir.x, r.dir.y, r.dir.z, r.t_max};
        hash = hash_bytes({reinterpret_cast<const char*>(numbers.data()), sizeof numbers}, hash);
    }
    return hash;
}

}  // namespace lancer
