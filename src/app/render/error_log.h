// The error log: error against run time, one row each time the number of samples has doubled.
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
    // Reads the references, if any. Throws Error if they cannot be read.
    explicit ErrorLog(const RenderOptions& options);

    // Whether a log or a reference is requested.
    bool is_wanted() const { return !path_.empty() || reference_; }
    // Throws Error (invalid_input) if the references do not have the size of this picture.
    void require_size(const Image& picture) const;
    // Warns of references with the same random numbers as a picture of that seed, or as each other.
    void warn_of_shared_samples(uint64_t seed) const;
    // Adds a row, which is written at once, so that it survives a crash. If that fails, a warning says so, as the
    // picture is worth more. stats: the present figures, with the time that the
    // picture took.
    void add(const Image& picture, const RunStats& stats, double cpu_seconds);
    // The log so far, and the same for a render that goes on from another.
    const std::string& text() const { return text_; }
    void begin_with(const std::string& text) { text_ = text; }
    // Whether the file lacks rows because it could not be written. The next row that can be written brings them along.
    bool is_behind() const { return is_behind_; }
    // Metrics of the last row against the reference; nothing without one.
    const std::optional<Metrics>& last() const { return last_; }

private:
    std::string path_;
    std::optional<ComparedPicture> reference_, reference2_;
    std::string text_;
    bool is_behind_ = false;
    std::optional<Metrics> last_;
};

}  // namespace lancer
