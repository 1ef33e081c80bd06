// The list of integrators. A new integrator is a header, an alternative of the variant below, a value of IntegratorKind
// with its name (scene/description/render_settings.h) and a file render/kernel/NAME.cpp.
#pragma once

#include <span>
#include <variant>

#include "integrators/ao.h"
#include "integrators/bias.h"
#include "integrators/classic/random_decision.h"
#include "integrators/classic/whitted.h"
#include "integrators/legacy/path.h"
#include "integrators/path/direct.h"
#include "integrators/path/path.h"

namespace lancer {

#ifdef LANCER_NO_CLASSIC
using AnyIntegrator = std::variant<Path, Direct, AmbientOcclusion>;
#else
using AnyIntegrator = std::variant<Path, Direct, Whitted, RandomDecision, AmbientOcclusion, LegacyPath>;
#endif

// Whether this build contains the classic integrators and --legacy.
bool knows_legacy();

// The integrator that the settings select, with their parameters.
AnyIntegrator make_integrator(const RenderSettings& settings);

// Maximal number of surface vertices of a path; 0: no limit.
uint32_t max_depth_of(const AnyIntegrator& integrator);

// Biases of the integrator, whatever its settings.
std::span<const IntegratorBias> biases_of(IntegratorKind kind);

}  // namespace lancer
