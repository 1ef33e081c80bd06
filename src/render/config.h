// RenderSettings made concrete: the objects that a Renderer works with. The one place where the kernel's settings come
// from those that a scene file and the command line give.
#pragma once

#include <string>

#include "integrators/integrator.h"
#include "render/kernel_settings.h"

namespace lancer {

struct RendererConfig {
    AnyIntegrator integrator = Path{};
    AccelKind accel = AccelKind::automatic;
    std::string isa = "avx2";
    KernelSettings kernel;
};

// batch: how many paths are under way at once, >= 1.
RendererConfig configure(const RenderSettings& settings, uint32_t batch);

}  // namespace lancer
