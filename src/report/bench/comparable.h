// Whether figures of two runs may stand side by side, and whether a second run confirms a first one. Times of
// different machines, compilers or instruction sets say nothing about programs; nor does a run on a busy machine.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lancer {

// What decides how fast a program runs. What a run did not tell is an empty text or nothing.
struct MachineBlock {
    std::string cpu, compiler, flags, embree, embree_isa, tbb;
    std::optional<int> num_cpus, threads;
    std::optional<bool> embree_asserts;  // Embree checks itself while it runs, which costs time
    std::optional<double> load;          // processes that wanted a CPU when the run began, over one minute
    // Told, not compared: they are what one compares, or follow from what is.
    std::string date, executable, lancer, build_id, widest_isa;
    std::optional<double> load_at_end;
};

// Beyond this load a run shares its CPUs.
inline constexpr double highest_load = 2.5;

// Why the figures of one run are not worth comparing at all; empty if they are.
std::vector<std::string> unfit(const MachineBlock& block);

// Why two runs are not comparable, each reason with both values; empty if they are. What either did not tell is one.
std::vector<std::string> not_comparable(const MachineBlock& a, const MachineBlock& b);

// What was found about several subjects, each reason once: "a, b: reason", in the order in which reasons turn up.
class Findings {
public:
    void add(const std::string& subject, const std::vector<std::string>& reasons);
    std::vector<std::string> lines() const;

private:
    std::vector<std::pair<std::string, std::string>> found_;  // reason, subjects
};

// A ratio of two measured times or speeds, and what it ranges over.
struct Ratio {
    double value = 0, low = 0, high = 0;
};

// Of medians with their least and largest values, all positive: the widest range that these allow.
Ratio ratio(const Ratio& a, const Ratio& b);

// Within 5 % of each other, the larger over the smaller, or ranges that overlap.
bool repeats(const Ratio& first, const Ratio& second);

}  // namespace lancer
