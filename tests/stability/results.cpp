#include "stability/results.h"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "core/parallel.h"

namespace lancer::stability {
bool Result::passes() const
{
    return problem.empty() && outcome.dropped == 0 &&
           std::all_of(outcome.measures.begin(), outcome.measures.end(), [](const Measure& m) { return m.passes(); });
}

std::optional<double> SampleCount::chance_below() const
{
    if (samples == 0 || dropped > 0) return {};
    return 3 / static_cast<double>(samples);
}

SampleCount count_samples(const std::vector<Result>& results)
{
    SampleCount all;
    for (const Result& r : results)
        if (r.judged) all += {r.outcome.samples, r.outcome.dropped};
    return all;
}

Result run_row(const Row& row, const Setup& setup, unsigned threads)
{
    Result result{row.id, row.stiff, row.reference, row.rays ? setup.accelerator : "", !setup.fast(), "", {}, 0};
    const auto start = std::chrono::steady_clock::now();
    try {
        const auto run = [&] { result.outcome = row.run(setup); };
        if (row.own_threads)
            run();
        else
            with_threads(threads, run);
        if (result.outcome.measures.empty()) result.problem = "nothing was measured";
    } catch (const std::exception& e) {
        result.problem = e.what();
    }
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

std::string to_json(const std::vector<Result>& results, const std::string& tier)
{
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const Result& r : results) {
        nlohmann::ordered_json measures = nlohmann::ordered_json::array();
        for (const Measure& m : r.outcome.measures) {
            nlohmann::ordered_json measure{{"what", m.what}, {"value", m.value}};
            if (m.judged)
                measure.update({{"bound", m.bound == Bound::at_most    ? "at_most"
                                          : m.bound == Bound::at_least ? "at_least"
                                                                       : "exactly"},
                                {"threshold", m.threshold},
                                {"pass", m.passes()}});
            measures.push_back(std::move(measure));
        }
        rows.push_back({{"id", r.id},
                        {"stiff", r.stiff},
                        {"reference", r.reference},
                        {"accelerator", r.accelerator},
                        {"judged", r.judged},
                        {"pass", r.passes()},
                        {"problem", r.problem},
                        {"seconds", r.seconds},
                        {"samples", r.outcome.samples},
                        {"dropped", r.outcome.dropped},
                        {"rejected_rays", r.outcome.rejected},
                        {"measures", std::move(measures)}});
    }
    return nlohmann::ordered_json{{"tier", tier}, {"rows", std::move(rows)}}.dump(1) + "\n";
}

}  // namespace lancer::stability
