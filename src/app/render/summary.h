// What lancer render tells about a run, besides its pictures: on stderr, one line a fact.
#pragma once

#include <optional>

#include "app/options/options.h"
#include "integrators/integrator.h"
#include "render/estimators/pilot.h"
#include "report/metrics/metrics.h"
#include "report/stats_json.h"

namespace lancer {

// With --verbose, before the first ray: figures of the scene, options that reproduce the run, the kernel and the
// features that it leaves out. settings: resolved.
void print_start(const RunStats& stats, const RenderSettings& settings);

// With --verbose: cells without camera rays, splitting and roulette.
void print_sampling_plan(const AnyIntegrator& integrator, const SamplingPlan& plan);

// A warning with the command that shows the first sample that was not finite; nothing if there was none.
void print_dropped_samples(const RunStats& stats, const RenderSettings& settings, const SceneChoice& scene);

// Where the error comes from, and the command that shows the largest outlier.
void print_error_sources(const ErrorSources& sources, const RenderSettings& settings, const SceneChoice& scene);

// After the run: rays, error, what stopped it, seconds of each phase. metrics: against options.reference.
void print_summary(const RunStats& stats, const RenderOptions& options, const std::optional<Metrics>& metrics);

}  // namespace lancer
