// Runs of lancer itself for a study: references, and methods that are options of lancer render.
#pragma once

#include "app/study/work.h"

namespace lancer {

// Renders the two halves of the reference unless they exist; `figures` gets its description. Nothing after an
// interrupt. Throws Error if the scene cannot be read or its reference cannot be rendered.
std::optional<Reference> draw_reference(StudyWork& work, const StudyPlan::Scene& scene, StudyScene& told);

// Renders unless the same has been rendered before. Nothing after an interrupt.
std::optional<RunResult> run_lancer(StudyWork& work, const StudyPlan::Scene& scene, const StudyPlan::Method& method,
                                    uint64_t seed, const Reference& reference);

}  // namespace lancer
