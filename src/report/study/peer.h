// The JSON lines of bench/peers/run, by which other renderers report their runs, and the choice of their sample counts.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace lancer {

struct PeerAbout {
    std::string version;
    bool seeds = false;    // else its random numbers are always the same
    bool squares = false;  // samples per pixel must be square numbers
};
// name: of the peer, for messages. Throws Error (failed) for anything but such an object.
PeerAbout read_peer_about(const std::string& name, const std::string& json);

struct PeerRecord {
    uint32_t spp = 0;
    double render_wall_s = 0;
    double render_cpu_s = std::numeric_limits<double>::quiet_NaN();  // NaN: unknown
    std::vector<std::string> biases;
};
// A line for each picture, in this order of samples. Throws Error (failed) for anything else.
std::vector<PeerRecord> read_peer_records(const std::string& name, const std::string& lines,
                                          const std::vector<uint32_t>& spps);

// The minimal duration of the first picture used to measure speed, as a part of the study's time.
inline constexpr double probe_part = 1.0 / 16;

// Samples per pixel of the pictures of a run, ascending fourfold, so that all together take a third more than the last;
// that one takes the time. Without a time up to `most`, which holds beside a time as well. `squares`: of square
// numbers.
std::vector<uint32_t> peer_samples(double seconds_per_sample, std::optional<double> time, std::optional<uint32_t> most,
                                   bool squares);

}  // namespace lancer
