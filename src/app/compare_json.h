// What lancer compare measured, and the same as JSON.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/compared_channels.h"
#include "app/options/options.h"
#include "report/metrics/flip.h"
#include "report/metrics/metrics.h"
#include "report/metrics/noise_test.h"

namespace lancer {

struct ComparedErrors {
    size_t pixels = 0;
    Metrics metrics{};
    Flip flip{};
    std::optional<size_t> beyond_one_step{};                  // pixels, with --steps
    std::string_view judged_by{};                             // the metric that --fail-above is for
    double judged = 0;                                        // its value
    std::optional<double> unbiased{}, reference_noise{};      // with a second reference
    std::vector<std::string> shared{}, shared_with_second{};  // pictures of the same samples, as sentences
};

// "lancer.compare/1": docs/json/compare.schema.json.
std::string compare_json(const CompareOptions& options, const ComparedErrors& errors, const DifferingChannels& channels,
                         const std::optional<NoiseTest>& noise, const std::string& verdict);

}  // namespace lancer
