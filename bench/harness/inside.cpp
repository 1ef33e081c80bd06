#include "harness/inside.h"

#include "harness/timing.h"
#include "render/specialize.h"

namespace lancer::bench {
namespace {

class Clocked final : public Accelerator {
public:
    explicit Clocked(const Accelerator& accel) : accel_(accel) {}

    Hit closest(const Ray& ray) const override
    {
        const Stopwatch watch(inside_);
        return accel_.closest(ray);
    }
    bool any(const Ray& ray) const override
    {
        const Stopwatch watch(inside_);
        return accel_.any(ray);
    }
    void closest(std::span<const Ray> rays, std::span<Hit> hits, Coherence coherence) const override
    {
        const Stopwatch watch(inside_);
        accel_.closest(rays, hits, coherence);
    }
    void any(std::span<const Ray> rays, std::span<uint8_t> occluded) const override
    {
        const Stopwatch watch(inside_);
        accel_.any(rays, occluded);
    }
    AccelStats stats() const override { return accel_.stats(); }

    double inside() const { return inside_; }

private:
    class Stopwatch {
    public:
        explicit Stopwatch(double& sum) : sum_(sum), start_(wall_ns()) {}
        ~Stopwatch() { sum_ += wall_ns() - start_; }
        Stopwatch(const Stopwatch&) = delete;
        Stopwatch& operator=(const Stopwatch&) = delete;

    private:
        double& sum_;
        double start_;
    };

    const Accelerator& accel_;
    mutable double inside_ = 0;
};

}  // namespace

RenderTime clock_render(const Stage& stage, uint32_t spp)
{
    const Clocked accel(stage.renderer.accelerator());
    const TileKernel kernel = make_tile_kernel(stage.scene, accel, stage.renderer.integrator(), stage.config.kernel,
                                               stage.renderer.kernel_choice());
    Film film = stage.film();
    const auto known = stage.renderer.plan(stage.camera, film.width, film.height);
    const SamplingPlan& plan = *known;
    Workspace workspace;
    Counters counters;
    const double start = wall_ns();
    for (const Tile& tile : stage.tiles()) kernel(plan, stage.camera, film, tile, {0, spp}, workspace, counters);
    return {wall_ns() - start, accel.inside()};
}

}  // namespace lancer::bench
