// How long the hand waits: from an input that changes the picture to the first image of it on the screen.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace lancer {

class Latency {
public:
    // An input of this time, by the clock of the window, asked for a sight; the first one that nothing was drawn of yet
    // counts.
    void asked(uint64_t sight, double seconds)
    {
        if (!waiting_since_) sight_ = sight, waiting_since_ = seconds;
    }
    // A frame with an image of this sight was on the screen at this time.
    void drawn(uint64_t sight, double seconds)
    {
        if (!waiting_since_ || sight < sight_) return;
        seconds_.push_back(seconds - *waiting_since_);
        waiting_since_.reset();
    }
    const std::vector<double>& seconds() const { return seconds_; }

private:
    uint64_t sight_ = 0;
    std::optional<double> waiting_since_;
    std::vector<double> seconds_;
};

}  // namespace lancer
