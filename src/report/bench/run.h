// What `lancer bench` measured on one mesh: methods beside each other, and figures of each. report/bench/results.h
// writes it as rows.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "report/bench/results.h"

namespace lancer {

// Nanoseconds of one item (a ray, a building, a picture), one of each round; round r of one method and of another ran
// side by side.
struct BenchTimes {
    std::vector<double> wall_ns, cpu_ns;
};

// The times of one thing, of each method in their order.
struct BenchGroup {
    std::string family;     // rays, build or picture
    std::string rays, way;  // of rays their kind, and whether they were asked singly or in batches
    unsigned threads = 1;
    bool by_cpu = true;  // which times count
    std::vector<BenchTimes> times;
};

// One figure of one method.
struct BenchFigure {
    std::string family, accel, rays, way;  // as in BenchGroup; accel: the method
    unsigned threads = 1;
    uint64_t rounds = 0;
    double wall_ns = 0, cpu_ns = 0;  // medians of one item
    bool by_cpu = true;
    Ranged time_ns{};                                        // of the times that count, with a 95 % interval
    std::optional<Ranged> ratio{};                           // of speeds to the baseline; of the baseline none
    std::vector<std::pair<std::string, double>> counters{};  // what else is known of it

    std::optional<double> counter(const std::string& name) const;
    // How it is called in files: the same figure of another run has the same name.
    std::string name(const std::string& mesh) const;
    // What it says: million rays per second, or seconds; higher is better, or lower is.
    Ranged value() const;
    bool is_speed() const { return family == "rays"; }
};

// Whether it is the same figure, of another run.
bool same_figure(const BenchFigure& a, const BenchFigure& b);

struct BenchRun {
    MachineBlock machine;
    std::string file, mesh;   // the file that was named, and its name without folder and ending
    std::string mesh_hash;    // of the triangles as they were traced
    uint64_t triangles = 0;   // those of instances count each time
    uint64_t mesh_bytes = 0;  // of vertices and triangles
    std::string baseline;     // name of the method
    std::vector<std::string> methods;
    std::vector<std::pair<std::string, std::string>> rays;  // kinds, and a hash of the rays of each
    double seconds = 0;                                     // that it took
    double picture_error = 0;
    bool interrupted = false;
    std::vector<BenchFigure> figures;

    // The figure of a method in the place of another one's; null if there is none.
    const BenchFigure* find(const BenchFigure& like, const std::string& accel) const;
};

// Figures of the methods that have a round, with ratios to the baseline within rounds. methods: their names.
std::vector<BenchFigure> figures_of(const BenchGroup& group, const std::vector<std::string>& methods,
                                    const std::string& baseline);

std::string to_json(const BenchRun& run);
// A row for each figure, always with the same columns.
std::string to_csv(const BenchRun& run);
// name: for messages. Throws Error (invalid_input) for what `lancer bench` has not written.
BenchRun read_bench_run(const std::string& name, const std::string& json);

}  // namespace lancer
