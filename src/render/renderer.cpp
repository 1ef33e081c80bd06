#include "render/renderer.h"

#include <algorithm>

#include "core/parallel.h"
#include "geometry/same_shapes.h"
#include "render/estimators/background_only.h"
#include "scene/alpha_test.h"

namespace lancer {
namespace {

// Whether only bounce rays will be traced: a path tracer under a constant environment, as far as that is known before
// all pictures are read.
RayUse use_of_rays(bool may_have_emitters, const AnyIntegrator& integrator)
{
    const auto* path = std::get_if<Path>(&integrator);
    return path && !path->direct.always && !may_have_emitters ? RayUse::bounces : RayUse::all;
}

// Resolves AccelKind::automatic.
void choose_accelerator(const Geometry& geometry, bool may_have_emitters, RendererConfig& settings)
{
    if (settings.accel == AccelKind::automatic)
        settings.accel = fastest_accelerator(geometry, use_of_rays(may_have_emitters, settings.integrator));
}

// The accelerator points into the geometry of its scene, and other renderers may take it over.
std::shared_ptr<const Accelerator> with_scene(std::unique_ptr<Accelerator> accelerator,
                                              std::shared_ptr<const Scene> scene)
{
    struct Both {
        std::shared_ptr<const Scene> scene;
        std::unique_ptr<Accelerator> accelerator;
    };
    const auto both = std::make_shared<Both>(Both{std::move(scene), std::move(accelerator)});
    return {both, both->accelerator.get()};
}

}  // namespace

Renderer::Renderer(SceneBuilder builder, const RendererConfig& settings, Diagnostics& diagnostics,
                   const std::function<void()>& accelerator_built, const Renderer* before)
    : settings_(settings)
{
    choose_accelerator(builder.geometry(), builder.may_have_emitters(), settings_);
    const bool serves = before && before->settings_.accel == settings_.accel &&
                        before->settings_.isa == settings_.isa &&
                        has_same_opaque_shapes(before->scene_->geometry, builder.geometry());
    // The geometry is at its final address.
    std::unique_ptr<Accelerator> built;
    if (!serves) built = make_accelerator(settings_.accel, builder.geometry(), settings_.isa);
    if (accelerator_built) accelerator_built();
    scene_ = builder.finish(diagnostics);
    accel_ = serves ? before->accel_ : with_scene(std::move(built), scene_);
    choose();
}

Renderer::Renderer(Scene scene, const RendererConfig& settings) : settings_(settings)
{
    auto placed = std::make_unique<Scene>(std::move(scene));
    bind_alpha_test(*placed);
    scene_ = std::move(placed);
    choose_accelerator(scene_->geometry, scene_->has_emitters(), settings_);
    accel_ = with_scene(make_accelerator(settings_.accel, scene_->geometry, settings_.isa), scene_);
    choose();
}

Renderer::Renderer(const Renderer& of_scene, const RendererConfig& settings)
    : scene_(of_scene.scene_), settings_(settings), accel_(of_scene.accel_)
{
    settings_.accel = of_scene.settings_.accel;
    choose();
}

Renderer::Renderer(std::unique_ptr<const Scene> scene, const Renderer& before, const RendererConfig& settings)
    : scene_(std::move(scene)), settings_(settings), accel_(before.accel_)
{
    settings_.accel = before.settings_.accel;
    choose();
}

void Renderer::choose()
{
    choice_ = choose_kernel(*scene_, settings_.integrator, settings_.kernel.profile);
    kernel_ = make_tile_kernel(*scene_, *accel_, settings_.integrator, settings_.kernel, choice_);
}

Renderer::~Renderer() = default;

PassResult Renderer::pass(const Camera& camera, Film& film, std::span<const Tile> tiles, SampleRange samples,
                          const std::stop_token& stop, const std::function<void(const Tile&)>& tile_done) const
{
    return trace(*plan(camera, film.width, film.height), camera, film, tiles, samples, stop, tile_done);
}

PassResult Renderer::preview(const Camera& camera, Film& film, std::span<const Tile> tiles, SampleRange samples,
                             const std::stop_token& stop, const std::function<void(const Tile&)>& tile_done) const
{
    return trace({}, camera, film, tiles, samples, stop, tile_done);
}

PassResult Renderer::trace(const SamplingPlan& plan, const Camera& camera, Film& film, std::span<const Tile> tiles,
                           SampleRange samples, const std::stop_token& stop,
                           const std::function<void(const Tile&)>& tile_done) const
{
    PassResult result;
    parallel_for(tiles.size(), [&](size_t i) {
        if (stop.stop_requested()) {
            const std::lock_guard lock(mutex_);
            result.left.push_back(tiles[i]);
            return;
        }
        std::unique_ptr<Workspace> w;
        {
            std::lock_guard lock(mutex_);
            if (!workspaces_.empty()) {
                w = std::move(workspaces_.back());
                workspaces_.pop_back();
            }
        }
        if (!w) w = std::make_unique<Workspace>();
        Counters counters;
        kernel_(plan, camera, film, tiles[i], samples, *w, counters);
        {
            std::lock_guard lock(mutex_);
            result.counters += counters;
            workspaces_.push_back(std::move(w));
        }
        if (tile_done) tile_done(tiles[i]);
    });
    return result;
}

Color Renderer::replay(const Camera& camera, uint32_t width, uint32_t height, const SampleId& id,
                       const PathListener& listener) const
{
    return lancer::replay(*scene_, *accel_, settings_.integrator, settings_.kernel, *plan(camera, width, height),
                          camera, width, id, listener);
}

std::shared_ptr<const SamplingPlan> Renderer::plan(const Camera& camera, uint32_t width, uint32_t height,
                                                   const std::stop_token& stop) const
{
    // What is asked for stays with who asked, whatever camera comes next.
    const auto plan_of = [](std::shared_ptr<const Piloted> known) {
        const SamplingPlan* plan = &known->plan;
        return std::shared_ptr<const SamplingPlan>(std::move(known), plan);
    };
    {
        const std::lock_guard lock(mutex_);
        if (piloted_ && piloted_->camera == camera && piloted_->width == width && piloted_->height == height)
            return plan_of(piloted_);
    }
    // Without the lock: the pilot runs in parallel, and a thread that waits for it may take up other work. Two threads
    // that ask at once both find the same plan.
    const auto* path = std::get_if<Path>(&settings_.integrator);
    SamplingPlan plan = path
                            ? make_plan(*scene_, *accel_, *path, settings_.kernel, choice_, camera, width, height, stop)
                            : SamplingPlan{};
    if (stop.stop_requested()) return nullptr;
    find_background_only(*scene_, camera, width, height, plan);
    auto found = std::make_shared<const Piloted>(Piloted{camera, width, height, std::move(plan)});
    {
        const std::lock_guard lock(mutex_);
        piloted_ = found;
    }
    return plan_of(std::move(found));
}

std::vector<Tile> make_tiles(const Tile& crop, uint32_t size)
{
    std::vector<Tile> tiles;
    if (crop.x0 >= crop.x1) return tiles;
    for (uint32_t y = crop.y0 / size * size; y < crop.y1; y += size)
        for (uint32_t x = crop.x0 / size * size; x < crop.x1; x += size)
            tiles.push_back(
                {std::max(x, crop.x0), std::max(y, crop.y0), std::min(x + size, crop.x1), std::min(y + size, crop.y1)});
    return tiles;
}

}  // namespace lancer
