// How far a picture is from what it converges to, as its own samples tell. As all errors here: the mean over pixels and
// channels of (x - r)^2 / (r^2 + 0.01). What stands for r^2 must not hold the picture's own noise: a dark pixel with
// one bright sample has a large relative error, and would divide it by itself.
#pragma once

#include <optional>
#include <vector>

#include "core/film.h"
#include "report/metrics/statistics.h"

namespace lancer {

// From half buffers: of twice as many samples the first half and the second are two pictures, and how far these lie
// apart tells how far their mean is from the truth. Two halves of n / 2 Sobol' points each are worth less than the n
// together, so this is an upper estimate; and it is a bound: the mean over pixels, and one standard error of that mean,
// which is much only where few pixels have most of the error. Needs no sum but one picture of 20 bytes a pixel, and
// takes its time only where samples have doubled. Rousselle, Knaus, Zwicker, "Adaptive Rendering with Non-Local Means
// Filtering", 2012, section 5, has such buffers.
class HalfBuffers {
public:
    // Now and then, but each time that samples have doubled. Of pixels that have less than twice the samples of a half
    // the estimate is the last one and falls as 1 / samples.
    void look(const Film& film);
    // Relative mean squared error; nothing before the second look.
    std::optional<double> rel_mse() const { return error_; }

private:
    struct Half {
        Color mean;
        uint32_t n = 0;
        float error = -1;  // of the pixel then; negative: not known
    };
    std::vector<Half> halves_;
    std::optional<double> error_;
};

// From replicates, which are independent of one another whatever points each has: their scatter tells the error without
// a bias, so that an interval can be given for the error that the picture has in fact.
struct ReplicateError {
    double rel_mse = 0;
    Interval interval;  // 95 %
};
// replicates: how many each pixel has. Nothing where no pixel has samples of two.
std::optional<ReplicateError> estimate_from_replicates(const Film& film, uint32_t replicates);

}  // namespace lancer
