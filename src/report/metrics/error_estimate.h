// Error estimates of a picture from its own samples, as for all errors here: the mean over pixels and channels of (x -
// r)^2 / (r^2 + 0.01). The estimate of r^2 must not contain the picture's own noise: a dark pixel with one bright
// sample would divide its error by itself.
#pragma once

#include <optional>
#include <vector>

#include "core/film.h"
#include "report/metrics/statistics.h"

namespace lancer {

// Error estimate from half buffers: the first and the second half of the samples are two pictures whose difference
// estimates the error of their mean. Two halves of n / 2 Sobol' points are worse than n together, so this is an upper
// estimate; and it adds one standard error of the mean over pixels, which is large only if few pixels have most of the
// error. It keeps one picture of 20 bytes per pixel and is computed only when the number of samples has doubled.
// Rousselle, Knaus, Zwicker, "Adaptive Rendering with Non-Local Means Filtering", 2012, section 5, uses such buffers.
class HalfBuffers {
public:
    struct Half {
        Color mean;
        uint32_t n = 0;
        float error = -1;  // of the pixel at that time; negative: unknown
    };
    HalfBuffers() = default;
    // As halves() and rel_mse() of others were.
    HalfBuffers(std::vector<Half> halves, std::optional<double> error) : halves_(std::move(halves)), error_(error) {}
    // Must be called each time the number of samples has doubled; other calls are allowed. Pixels with less than twice
    // the samples of their half keep the last estimate, scaled by 1 / samples.
    void look(const Film& film);
    // Relative mean squared error; nothing before the second call of look().
    std::optional<double> rel_mse() const { return error_; }
    // Parallel to the pixels; empty before the first call.
    const std::vector<Half>& halves() const { return halves_; }

private:
    std::vector<Half> halves_;
    std::optional<double> error_;
};

// Error estimate from independent replicates: their scatter is unbiased and gives an interval for the actual error.
struct ReplicateError {
    double rel_mse = 0;
    Interval interval;  // 95 %
};
// replicates: number per pixel. Nothing if no pixel has samples of two replicates.
std::optional<ReplicateError> estimate_from_replicates(const Film& film, uint32_t replicates);

}  // namespace lancer
