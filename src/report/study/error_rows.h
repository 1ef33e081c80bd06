// The log of errors against run time that a render writes (--error-log) and a study reads: CSV, one row each time that
// it was looked at.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/image.h"
#include "report/metrics/metrics.h"
#include "report/study/results.h"

namespace lancer {

// Reals are NaN where they are not known: empty fields.
struct ErrorRow {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    double spp = unknown;                      // a mean, where the pixels differ
    double wall_s = unknown, cpu_s = unknown;  // of rendering alone
    uint64_t camera_rays = 0, bounce_rays = 0, shadow_rays = 0;
    double rmse = unknown, relmse = unknown, relmse_trimmed = unknown, relmse_unbiased = unknown;
    double smape = unknown, flip = unknown;
    double estimated_error = unknown, estimated_low = unknown, estimated_high = unknown;
};

// The line of names, and a row, each with the end of its line.
std::string error_rows_head();
std::string to_csv(const ErrorRow& row);

// name: of the file, for messages. Throws Error (invalid_input) with file and line for other columns and for what is no
// number.
std::vector<ErrorRow> read_error_rows(const std::string& name, const std::string& csv);

// Fills in the errors of the picture: those of Metrics, with a second reference (or null) the unbiased one, and FLIP if
// it is wanted, which takes a while. Throws as compare().
Metrics measure_errors(ErrorRow& row, const Image& picture, const Image& reference, const Image* second,
                       bool with_flip);

// As a study has it: the relMSE is the unbiased one where there is one. spp is a whole number.
ErrorPoint point_of(const ErrorRow& row);

}  // namespace lancer
