// All measurements of `lancer bench` on one scene, within a given time.
#pragma once

#include <functional>
#include <string>

#include "app/bench/bench_scene.h"
#include "app/options/options.h"
#include "report/bench/run.h"

namespace lancer {

// What is measured, before anything is: the mesh and the kinds of rays.
BenchRun describe_bench(const BenchScene& scene, const BenchOptions& options);

struct BenchWork {
    const BenchOptions& options;
    double end = 0;  // wall_ns() at which the last round is over
    std::function<bool()> is_stopped;
    std::function<void(const std::string&)> note;
};

// Adds figures to the run. Must be called inside with_threads of all threads that may be used. Throws Error (failed) if
// the time ended before anything was measured; after an interrupt there may be no figure.
void measure_bench(const BenchScene& scene, const BenchWork& work, BenchRun& run);

}  // namespace lancer
