// Whether a study makes sense. Kept apart from reading, as studies come from files and from programs.
#pragma once

#include <string>

#include "report/study/results.h"

namespace lancer {

// Throws Error(invalid_input) with `name` as the place for the first of: a name that is empty or given twice, a run of
// an unknown scene or method, two runs of the same scene, method and seed, two remarks or levels of
// the same scene and method, an unknown baseline, a noise that is
// negative or not finite, and what check_points() refuses.
void check_study(const std::string& name, const Study& study);

// The same for points that do not ascend in samples and seconds, seconds that are negative or not finite, and errors
// that are negative, but for a relMSE, of which estimates with two references may be.
void check_points(const std::string& name, const StudyRun& run);

}  // namespace lancer
