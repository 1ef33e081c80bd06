// A scene ready to render, with its accelerator and its kernel. All kinds of rendering (whole picture, crop,
// progressive, one sample) use pass() or replay().
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <stop_token>
#include <vector>

#include "render/config.h"
#include "render/estimators/pilot.h"
#include "render/specialize.h"
#include "scene/build/scene_builder.h"

namespace lancer {

// Result of a pass.
struct PassResult {
    Counters counters;
    std::vector<Tile> left;  // tiles without its samples, if it was stopped before them; in any order

    bool is_complete() const { return left.empty(); }
};

class Renderer {
public:
    // The first builds the accelerator while pictures are still being read, calls accelerator_built, and then finishes
    // the scene. Problems with pictures go to diagnostics. before: a renderer whose accelerator is taken if it is of
    // the same kind and geometry, or null. Both throw Error (failed) and must be called inside with_threads.
    Renderer(SceneBuilder scene, const RendererConfig& settings, Diagnostics& diagnostics,
             const std::function<void()>& accelerator_built = {}, const Renderer* before = nullptr);
    Renderer(Scene scene, const RendererConfig& settings);
    // The scene and the accelerator of another renderer with other settings; those of the accelerator are not used.
    Renderer(const Renderer& of_scene, const RendererConfig& settings);
    // Of a scene that is known to have the shapes and the opacity of that of the renderer before: see relit().
    Renderer(std::unique_ptr<const Scene> scene, const Renderer& before, const RendererConfig& settings);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    // Adds samples [begin, end) of every pixel of the tiles to the film. For bits that do not depend on how samples are
    // split into passes, begin and end must be multiples of samples_per_block, except the last end. Tiles must lie
    // within film.crop and not overlap. `stop` is tested once per tile; what is left may be given to a later pass of
    // the same samples. tile_done is called after each tile, from any thread; the film then contains that tile's
    // samples until the pass ends.
    PassResult pass(const Camera& camera, Film& film, std::span<const Tile> tiles, SampleRange samples,
                    const std::stop_token& stop = {}, const std::function<void(const Tile&)>& tile_done = {}) const;

    // The same without a plan, for a first look: the picture has the same mean, other bits and more noise.
    PassResult preview(const Camera& camera, Film& film, std::span<const Tile> tiles, SampleRange samples,
                       const std::stop_token& stop = {}, const std::function<void(const Tile&)>& tile_done = {}) const;

    // See lancer::replay. width, height: of the whole picture.
    Color replay(const Camera& camera, uint32_t width, uint32_t height, const SampleId& id,
                 const PathListener& listener) const;

    // The sampling plan for a picture of this size; computed once, until another camera or size is asked for. May be
    // called from any thread. Null, soon after, if `stop` is requested before it is known.
    std::shared_ptr<const SamplingPlan> plan(const Camera& camera, uint32_t width, uint32_t height,
                                             const std::stop_token& stop = {}) const;

    const AnyIntegrator& integrator() const { return settings_.integrator; }
    const Scene& scene() const { return *scene_; }
    const Accelerator& accelerator() const { return *accel_; }
    const KernelChoice& kernel_choice() const { return choice_; }
    Profile profile() const { return choice_.profile(); }
    // Never automatic.
    AccelKind accelerator_kind() const { return settings_.accel; }
    bool shares_accelerator_with(const Renderer& other) const { return accel_ == other.accel_; }

private:
    void choose();
    PassResult trace(const SamplingPlan& plan, const Camera& camera, Film& film, std::span<const Tile> tiles,
                     SampleRange samples, const std::stop_token& stop,
                     const std::function<void(const Tile&)>& tile_done) const;

    std::shared_ptr<const Scene> scene_;
    RendererConfig settings_;
    std::shared_ptr<const Accelerator> accel_;  // with the scene whose geometry it is of, which may be another one
    KernelChoice choice_;
    TileKernel kernel_;
    mutable std::mutex mutex_;  // guards what follows
    // Unused workspaces: a thread takes one for each tile and returns it.
    mutable std::vector<std::unique_ptr<Workspace>> workspaces_;
    mutable std::shared_ptr<const Piloted> piloted_;  // the last one; null: none yet
};

// The crop in tiles of at most size x size pixels, aligned to the whole picture.
std::vector<Tile> make_tiles(const Tile& crop, uint32_t size);

}  // namespace lancer
