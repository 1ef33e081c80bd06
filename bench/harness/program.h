// What every bench program does around its own work: options, machine block, files, exit codes as of `lancer`.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/report.h"

namespace lancer::bench {

struct Options {
    bool full = false;  // else what a minute or two allows
    unsigned threads = 1;
    unsigned repetitions = 5;
    std::vector<std::string> only;    // names of meshes or scenes; empty: all
    std::vector<std::string> accels;  // names of accelerators; empty: all
    std::vector<std::string> meshes;  // OBJ files, besides our own and the shared ones
    std::string output;               // empty: none
    std::string cache = "build/bench-cache";

    bool wants(const std::string& name) const;
    bool wants_accel(const std::string& name) const;
};

// name: "bench_accel". description: what its help begins with. body adds rows to the report; a program that measured
// nothing has failed, and one whose report tells of a failure, when that is written; it may use all CPUs, and what is
// measured sets its own limit. Returns the exit code.
int run_program(int argc, char** argv, const std::string& name, const std::string& description,
                const std::function<void(const Options&, Report&)>& body);

// A line about a row, for a reader.
void print_row(const Json& row);

}  // namespace lancer::bench
