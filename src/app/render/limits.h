// How a render is cut into passes and when it has enough: of samples, of time, or because its error is small enough.
// Its clock runs only while rays are traced, so that what looking at the picture takes is in no figure.
#pragma once

#include <cstdint>
#include <optional>

#include "core/enum_names.h"

namespace lancer {

enum class Stop { samples, time, error };
template <>
inline constexpr auto enum_names<Stop> = std::to_array<std::string_view>({"samples", "time", "error"});

// Number of samples if only time or error stops a render.
inline constexpr uint32_t unlimited_spp = 1u << 28;

class RenderLimits {
public:
    struct Given {
        uint32_t spp = 0;             // the most samples of a pixel
        std::optional<double> time;   // seconds of rendering
        std::optional<double> error;  // square root of the relative mean squared error, as estimated
        bool looks_early = false;     // the picture is looked at after 1, 2, 4, 8 samples, too
    };
    explicit RenderLimits(const Given& given) : given_(given) {}

    // Whether passes end anywhere, not only where samples have doubled.
    bool has_stop_rule() const { return given_.time || given_.error; }
    // Where a pass ends that begins with sample `done`: at the latest where samples have doubled, since halves are
    // compared there; with a stop rule after a tenth more, which is what it may come too late by. Never above 256
    // samples more: a tile of a pass is not left before it is done.
    uint32_t next_end(uint32_t done) const;
    // Whether a picture of so many samples is worth denoising to learn its error: of enough to judge, and of a quarter
    // more than at the last look.
    bool looks_at_denoised(uint32_t samples);
    // Whether errors are looked at that are known only there.
    bool is_mark(uint32_t samples) const;

    // What the passes before have taken of which this render goes on.
    void begin_with(double wall_s, double cpu_s) { wall_ = wall_s, cpu_ = cpu_s, passes_ = 1; }
    void begin_pass() { ++passes_, resume(); }
    void end_pass() { pause(); }
    // Within a pass: no rays are traced from one to the other.
    void pause();
    void resume();
    // Of all passes, and what the one under way has taken.
    double wall_seconds() const;
    double cpu_seconds() const { return cpu_; }
    // From any thread. A picture without a sample in each pixel is none: the first pass is always ended.
    bool is_out_of_time() const { return given_.time && passes_ > 1 && wall_seconds() >= *given_.time; }
    // After a pass; estimated: nothing if not known.
    std::optional<Stop> reached(uint32_t samples, std::optional<double> estimated) const;

private:
    Given given_;
    double wall_ = 0, cpu_ = 0;  // of passes that have ended
    double wall_begin_ = 0, cpu_begin_ = 0;
    bool is_running_ = false;
    uint32_t passes_ = 0;
    uint32_t looked_at_ = 0;  // samples of the picture that was denoised last
};

}  // namespace lancer
