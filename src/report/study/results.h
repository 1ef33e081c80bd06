// What a study of error against run time measured: methods on scenes, each with several seeds, and the error of the
// picture at doubling numbers of samples. Plain data; study/json.h keeps it in files, study/statistics.h says what it
// means, study/page.h shows it.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "report/metrics/statistics.h"

namespace lancer {

// Of figures that there are none of, or that nobody measured.
inline constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

// The picture of one run at one moment. Seconds are those of rendering alone, since its beginning; rays likewise.
// Errors are against the reference, in linear radiance (report/metrics/metrics.h).
struct ErrorPoint {
    uint32_t spp = 0;
    double wall_s = 0, cpu_s = 0;  // cpu_s: NaN if not measured
    uint64_t rays_camera = 0, rays_bounce = 0, rays_shadow = 0;
    // NaN: not measured.
    double rmse = no_number;
    double relmse = no_number;
    double relmse_trimmed = no_number;
    double smape = no_number;
    double flip = no_number;
};

struct StudyRun {
    std::string scene, method;  // names of a StudyScene and a StudyMethod
    uint64_t seed = 0;
    std::vector<ErrorPoint> points;  // spp and wall_s ascending
    bool failed = false;             // then its points, if any, count for nothing
    std::string problem;             // what went wrong
};

struct StudyMethod {
    std::string name, description;
    std::vector<std::string> biases;  // the bias ledger: what keeps its mean from the truth; empty: unbiased
    bool peer = false;                // another program
    std::string version;
    bool biased() const { return !biases.empty(); }
};

struct StudyScene {
    std::string name, description;
    std::string reference;  // where it is from: who drew it, samples, seconds, seed, hash
    // relMSE of the reference itself; 0 if it is exact. No error below it is told apart from another.
    double reference_noise_relmse = 0;
};

// What sets a method apart on one scene.
struct MethodOnScene {
    std::string scene, method;
    std::string left_out;    // why it has no runs there; empty: it has
    std::string not_ranked;  // why its figures are shown and not ranked; empty: nothing more is known against it
    // The reference of its own that its errors are against, and the noise of that; empty: the scene's.
    std::string reference;
    double reference_noise_relmse = 0;
};

// How bright the last pictures of a method are, over all its seeds, and how far their mean is from the reference.
struct PictureLevel {
    std::string scene, method;
    uint64_t pictures = 0;
    std::array<double, 3> ratio{};  // of the mean radiance to that of the reference, for each channel
    std::array<Interval, 3> ratio_interval{};
    // relMSE of what is left when the noise of pictures and reference is taken off, which an estimate may overdo.
    double systematic_relmse = 0;
    Interval systematic_interval;
};

struct Study {
    std::string title;
    std::vector<StudyScene> scenes;
    std::vector<StudyMethod> methods;
    std::vector<StudyRun> runs;
    std::vector<MethodOnScene> on_scenes;                      // each pair at most once; those with nothing to say lack
    std::vector<PictureLevel> levels;                          // likewise
    std::vector<std::pair<std::string, std::string>> machine;  // what is told, value
    std::vector<std::string> not_comparable;                   // why its figures may not stand side by side
    std::string baseline;                                      // name of the method that others are held against

    // What sets it apart; nothing does, if there is no entry.
    const MethodOnScene& on_scene(const std::string& scene, const std::string& method) const;
};

}  // namespace lancer
