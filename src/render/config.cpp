#include "render/config.h"

namespace lancer {

RendererConfig configure(const RenderSettings& s, uint32_t batch)
{
    return {.integrator = make_integrator(s),
            .accel = s.accel,
            .isa = std::string(name_of(s.isa)),
            .kernel = {.sampler = s.sampler,
                       .seed = s.seed,
                       .filter = Filter(s.filter),
                       .batch = batch,
                       .stop = stop_rule(s),
                       .stop_error = s.stop_error,
                       .clamp = clamps_samples(s),
                       .replicates = s.replicates}};
}

}  // namespace lancer
