// The verdict of lancer compare: tests of two pictures against their noise.
#pragma once

#include <optional>
#include <string>

#include "app/compared_picture.h"
#include "report/metrics/metrics.h"
#include "report/metrics/noise_test.h"

namespace lancer {

// Nothing if either picture has no variance.
std::optional<NoiseTest> test_noise(const ComparedPicture& picture, const ComparedPicture& reference);

// Prints the figures of the tests, one per line.
void print_noise(const NoiseTest& test, const ComparedPicture& picture, const ComparedPicture& reference);

// "same bits", "no difference found (smallest detectable bias 0.3 %)", "differ: ...": one line.
std::string verdict(const ComparedPicture& picture, const ComparedPicture& reference, const Metrics& metrics,
                    const std::optional<NoiseTest>& test);

}  // namespace lancer
