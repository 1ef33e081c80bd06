// The progress display on stderr: a line that is redrawn, plain lines at intervals, or JSON lines.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>

#include "app/options/options.h"

namespace lancer {

class Progress {
public:
    // automatic: a line on a terminal, else plain. spp: the final number, or seconds: the final time; 0: unlimited.
    Progress(ProgressKind kind, uint32_t spp, uint64_t pixels, std::optional<double> time_limit);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void begin_pass(SampleRange samples, size_t tiles);
    void tile_done();  // from any thread
    // error: the present estimate; rays: total so far.
    void end_pass(std::optional<double> error, uint64_t rays);
    // Clears the line, so that something else can be printed.
    void clear();

private:
    double samples() const;  // per pixel so far
    double fraction(double elapsed) const;
    void print(double now);

    enum class Style { line, plain, json, none } style_;
    uint32_t spp_;
    uint64_t pixels_;
    std::optional<double> time_limit_;
    double start_, next_;  // seconds; time of the next report
    SampleRange pass_{};
    size_t tiles_ = 1;
    std::atomic<size_t> tiles_done_{0};
    std::optional<double> error_;
    double rays_per_sample_ = 0;
    bool is_drawn_ = false;
    std::mutex mutex_;
};

}  // namespace lancer
