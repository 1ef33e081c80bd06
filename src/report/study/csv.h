// The runs of a study as CSV (RFC 4180), for spreadsheets and scripts: a line of names, then one row for each point.
//   scene,method,seed,spp,wall_s,cpu_s,rays_camera,rays_bounce,rays_shadow,
//   rmse,relmse,relmse_trimmed,smape,flip,failed,problem
// What was not measured is empty, an infinite error "inf"; numbers come back as the same bits. A run without points has
// one row that has no figures.
#pragma once

#include <string>
#include <vector>

#include "report/study/results.h"

namespace lancer {

std::string to_csv(const std::vector<StudyRun>& runs);

// Runs in the order of their first rows. name: of the file, for messages. Throws Error(invalid_input) with file and
// line: other columns, a row that is too short or too long, a figure that is no number, a quote that is not closed; or
// what check_points() of study/check.h refuses.
std::vector<StudyRun> read_study_csv(const std::string& name, const std::string& csv);

}  // namespace lancer
