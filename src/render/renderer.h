// A scene ready to render: the accelerator built, the kernel chosen. Every way of rendering (whole, crop, progressive,
// one sample) goes through pass() or replay().
#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <stop_token>
#include <string>

#include "integrators/integrator.h"
#include "render/estimators/pilot.h"
#include "render/specialize.h"

namespace lancer {

struct RenderSettings {
    AnyIntegrator integrator = Path{};
    AccelKind accel = AccelKind::automatic;
    std::string isa = "avx2";
    KernelSettings kernel;
};

// What a pass did. Incomplete if it was stopped before its last tile: some tiles then lack its samples.
struct PassResult {
    Counters counters;
    bool complete = true;
};

class Renderer {
public:
    // Builds the accelerator, then completes the scene if its pictures were still being read: problems with them go to
    // diagnostics, if given. Throws Error (failed). Call inside with_threads.
    Renderer(Scene scene, const RenderSettings& settings, Diagnostics* diagnostics = nullptr);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    // Adds samples [begin, end) of every pixel of the tiles to the film. Begin and end must be multiples of
    // samples_per_block for a picture to have the same bits however its samples are split; only the last end of all
    // may differ. Each tile must lie within film.crop, and no two may overlap. `stop` is looked at once a tile;
    // tile_done is called after each, from any thread; the film has that tile's samples then, and keeps them until the
    // pass has ended.
    PassResult pass(const Camera& camera, Film& film, std::span<const Tile> tiles, SampleRange samples,
                    const std::stop_token& stop = {}, const std::function<void(const Tile&)>& tile_done = {}) const;

    // See lancer::replay. width, height: of the whole picture.
    Color replay(const Camera& camera, uint32_t width, uint32_t height, const SampleId& id,
                 const PathListener& listener) const;

    // How paths spend their rays in a picture of that size: found out once, then known.
    const SamplingPlan& plan(const Camera& camera, uint32_t width, uint32_t height) const;

    const AnyIntegrator& integrator() const { return settings_.integrator; }
    const Scene& scene() const { return scene_; }
    const Accelerator& accelerator() const { return *accel_; }
    Profile profile() const { return profile_of(scene_, settings_.integrator, settings_.kernel.profile); }
    // Never automatic.
    AccelKind accelerator_kind() const { return settings_.accel; }

private:
    Scene scene_;
    RenderSettings settings_;
    std::unique_ptr<Accelerator> accel_;
    TileKernel kernel_;
    // Workspaces at rest: a thread takes one for a tile and puts it back.
    mutable std::mutex mutex_;
    mutable std::vector<std::unique_ptr<Workspace>> workspaces_;
    mutable std::optional<Piloted> piloted_;  // the last one
};

// The crop in tiles of at most size x size pixels, aligned to the whole picture.
std::vector<Tile> make_tiles(const Tile& crop, uint32_t size);

}  // namespace lancer
