// The list of integrators. A new one is a header, a word here and a file render/kernel/NAME.cpp; the command line, the
// scene files and the laws in tests/ take it from here.
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

// Whether the ways of the past are in this build.
bool knows_legacy();

// Whether an integrator is one of the two that the course's ray tracer had; with legacy the others go the student's
// way.
bool is_classic(std::string_view name);

// The first is the default.
std::vector<std::string_view> names_of_integrators();

// name: one of those.
AnyIntegrator make_integrator(std::string_view name, const IntegratorSettings& settings);

// How many surface vertices its paths have at most; 0: no limit.
uint32_t max_depth_of(const AnyIntegrator& integrator);

// What its pictures lack by its nature, as entries of the bias ledger.
std::vector<std::string> biases_of(const AnyIntegrator& integrator);

}  // namespace lancer
