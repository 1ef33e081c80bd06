// The list of integrators. A new integrator is a header, an alternative of the variant below and a file
// render/kernel/NAME.cpp. The command line, the scene files and the tests use this list.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "integrators/ao.h"
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

// Whether an integrator is whitted or random-decision. With --legacy all others are replaced by LegacyPath.
bool is_classic(std::string_view name);

// The first is the default.
std::vector<std::string_view> names_of_integrators();

// name: one of names_of_integrators().
AnyIntegrator make_integrator(std::string_view name, const IntegratorSettings& settings);

// Maximal number of surface vertices of a path; 0: no limit.
uint32_t max_depth_of(const AnyIntegrator& integrator);

// Biases of the integrator, as entries of the bias ledger.
std::vector<std::string> biases_of(const AnyIntegrator& integrator);

}  // namespace lancer
