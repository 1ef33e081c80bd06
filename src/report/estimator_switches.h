// The estimators that can be switched: what `lancer tune` and bench_estimators compare, picture by picture.
#pragma once

#include <vector>

#include "scene/description/render_options.h"

namespace lancer {

// A switch that leaves the mean of a picture alone.
using Estimator = const RenderOption*;

// All, in the order of render_options().
std::vector<Estimator> estimators();

bool is_on(const RenderSettings& settings, Estimator estimator);
// The settings with the other value, as if it was asked for.
RenderSettings switched_over(RenderSettings settings, Estimator estimator);

}  // namespace lancer
