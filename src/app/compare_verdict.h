// What lancer compare says about two pictures in words: the tests against their noise, and the verdict.
#pragma once

#include <optional>
#include <string>

#include "app/compared_picture.h"
#include "report/metrics/metrics.h"
#include "report/metrics/noise_test.h"

namespace lancer {

// Nothing where either picture has no variance.
std::optional<NoiseTest> test_noise(const ComparedPicture& picture, const ComparedPicture& reference);

// The figures of the test, a line for each.
void print_noise(const NoiseTest& test, const ComparedPicture& picture, const ComparedPicture& reference);

// "same bits", "no difference found (smallest detectable bias 0.3 %)", "differ: ...": one line.
std::string verdict(const ComparedPicture& picture, const ComparedPicture& reference, const Metrics& metrics,
                    const std::optional<NoiseTest>& test);

}  // namespace lancer
