// Error against run time: what a render was worth each time that its samples had doubled, as a table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/compared_picture.h"
#include "app/options/options.h"
#include "report/metrics/metrics.h"
#include "report/stats_json.h"

namespace lancer {

class ErrorLog {
public:
    // Reads the references, if there are any. Throws Error if they cannot be read.
    explicit ErrorLog(const RenderOptions& options);

    // Whether there is anything to note or to measure against.
    bool is_wanted() const { return !path_.empty() || reference_; }
    // Throws Error (invalid_input) unless the references are of such a picture.
    void require_size(const Image& picture) const;
    // Warns of references that are made of the random numbers of a picture of that seed, or of one another's.
    void warn_of_shared_samples(uint64_t seed) const;
    // A row of the table, which is written at once: what there is of it outlives whatever comes. stats: as they are
    // now; the clock of rendering stands still meanwhile.
    void add(const Image& picture, const RunStats& stats, double cpu_seconds);
    // Of the last row, against the reference; nothing if there is none.
    const std::optional<Metrics>& last() const { return last_; }

private:
    std::string path_;
    std::optional<ComparedPicture> reference_, reference2_;
    std::string text_;
    std::optional<Metrics> last_;
};

}  // namespace lancer
