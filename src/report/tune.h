// What each estimator that can be switched gives on a scene: pictures with it and without it, in turns.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "report/estimator_switches.h"
#include "report/metrics/statistics.h"
#include "scene/camera.h"

namespace lancer {

class Renderer;

struct TuneRequest {
    RenderSettings settings;  // resolved; the picture, whose time is compared
    PixelGrid grid = PixelGrid::centres;
    double seconds = 30;  // no round begins later, but six are drawn in any case
    std::function<void(uint32_t rounds)> round_done = [](uint32_t) {};
    std::function<bool()> is_stopped = [] { return false; };  // asked between pictures; the round is then dropped
};

struct RatioInterval {
    double median = 1;
    Interval interval{1, 1};  // 95 %
};

// An estimator with the other value, over the value of the settings.
struct TuneRow {
    Estimator option = nullptr;
    bool value = false;               // the other one
    RatioInterval mean;               // of the picture: 1 unless the other value misses light
    RatioInterval time, error, both;  // both: error times time
};

struct TuneResult {
    uint64_t pixels = 0;  // that were drawn of each picture
    uint32_t spp = 0, rounds = 0;
    std::vector<TuneRow> rows;  // estimators that change pictures of this scene, in the order of render_options()
};

// Draws some tiles of the picture in pairs, with other random numbers in each round. The error of a pair is the mean
// squared difference of its pictures, relative as everywhere; its time is CPU time, that of the sampling plan included.
// Switches that bias pictures are left out, and those that are built into the scene. base: with these settings. Must be
// called inside with_threads.
TuneResult tune(const Renderer& base, const CameraDescription& camera, const TuneRequest& request);

}  // namespace lancer
