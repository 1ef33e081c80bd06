// The tables of a study's page for one scene. A biased method carries its biases in every row.
#pragma once

#include <string>
#include <vector>

#include "report/page/document.h"
#include "report/study/statistics.h"

namespace lancer {

// The name, and below it the biases.
Cell method_cell(const StudyMethod& method);

// "12.3 [11.9 .. 12.8]"; an end beyond the measurements is told as such.
std::string time_text(const TimeToError& time);

// All of one scene; `all` as figures_of() gives it for each method.
struct SceneFigures {
    const Study& study;
    const StudyScene& scene;
    std::vector<MethodFigures> all;
};

Table times_table(const SceneFigures& f);       // seconds to each of study_targets, and to flip_target
Table speed_up_table(const SceneFigures& f);    // over the baseline, at equal error
Table efficiency_table(const SceneFigures& f);  // and the gain over the baseline, at equal time
Table slopes_table(const SceneFigures& f);
Table runs_table(const SceneFigures& f);  // how many, how far they got, at which speed
// Every kind of error at the longest time at which all methods that have runs were measured; without such a time at the
// end of each.
Table errors_table(const SceneFigures& f);

// How bright, and how far from the reference without noise; no rows where no pictures were looked at.
Table levels_table(const SceneFigures& f);

// Of every method on every scene, for the beginning of the page: the ratios of the times to an equal error and of FLIP
// at an equal time, and their geometric means over the scenes where a method is ranked.
Table overview_table(const Study& study);
// The same with a row for each method on each scene, for a terminal.
Table overview_rows(const Study& study);

}  // namespace lancer
