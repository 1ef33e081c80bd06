// How far a render is, on stderr: one line that is redrawn, plain lines now and then, or JSON lines.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>

#include "app/options/options.h"

namespace lancer {

class Progress {
public:
    // automatic: a line on a terminal, else plain. spp: in the end, unless that comes after so many seconds; 0: without
    // an end that is known.
    Progress(ProgressKind kind, uint32_t spp, uint64_t pixels, std::optional<double> time_limit);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void begin_pass(SampleRange samples, size_t tiles);
    void tile_done();  // from any thread
    // error: estimated, of the film as it is now, if it is known; rays: so far.
    void end_pass(std::optional<double> error, uint64_t rays);
    // Takes the line away, so that something else can be printed.
    void clear();

private:
    double samples() const;  // of a pixel, so far
    double fraction(double elapsed) const;
    void print(double now);

    enum class Style { line, plain, json, none } style_;
    uint32_t spp_;
    uint64_t pixels_;
    std::optional<double> time_limit_;
    double start_, next_;  // seconds; when the next report is due
    SampleRange pass_{};
    size_t tiles_ = 1;
    std::atomic<size_t> tiles_done_{0};
    std::optional<double> error_;
    double rays_per_sample_ = 0;
    bool is_drawn_ = false;
    std::mutex mutex_;
};

}  // namespace lancer
