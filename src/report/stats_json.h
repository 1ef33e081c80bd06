// The figures of a run: context, scene, settings, counters, phases. The program fills them; --stats writes them as
// JSON.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/film.h"
#include "render/counters.h"
#include "report/metrics/statistics.h"
#include "report/outliers.h"
#include "scene/description/render_settings.h"
#include "scene/specialisation.h"

namespace lancer {

struct RunStats {
    struct Context {
        std::string version, embree, parallel, compiler, build_type, instructions, cpu, command_line;
        std::optional<double> load_average;  // when the run began, over one minute; nothing if not known
    };
    struct SceneFigures {
        std::string file;
        uint64_t content_hash = 0;
        uint64_t triangles = 0, meshes = 0, instances = 0, spheres = 0, planes = 0, lights = 0, materials = 0;
        uint64_t accelerator_bytes = 0;
        uint64_t hidden_lights = 0;  // that no technique brings into the picture
        std::string added_light;     // of a bare mesh: which light it was given or not, and why
        std::vector<std::string> warnings;
        std::vector<UnusedFeature> unused_features;
        bool catches_shadows = false;     // what some material does, in a picture with alpha
        bool ignores_scattering = false;  // what media would do, if the integrator followed it
    };
    struct SettingsUsed {
        RenderSettings render;  // resolved
        Tile crop;
        uint32_t threads = 0, tile = 0, batch = 0;
        std::string kernel;      // see Profile
        std::string hash;        // of all that decides the value of a pixel, but the scene
        std::string options;     // of the command line, that decide it again for the same scene
        std::string identity{};  // of a frame of a film: app/render/identity.h; else empty
    };
    struct Phase {
        std::string name;
        double wall_s = 0, cpu_s = 0;
        uint64_t resident_bytes = 0, peak_bytes = 0;  // of the process, at its end: now, and at most so far
    };
    // A look at the whole scene while it was built; part of a phase.
    struct Analysis {
        std::string name;
        double wall_s = 0;
    };
    // State of the film after a pass.
    struct Progress {
        uint32_t spp = 0;
        double seconds = 0;
        std::optional<double> error{};  // see estimated_error
    };

    Context context;
    SceneFigures scene;
    SettingsUsed settings;
    std::vector<Phase> phases;
    std::vector<Analysis> analyses;
    std::vector<Progress> passes;
    Counters counters;
    uint64_t samples = 0;  // in the film
    double render_s = 0;
    // Square root of the estimated relative mean squared error; 0: unknown. An upper estimate from half buffers; with
    // replicates unbiased and with an interval.
    std::optional<double> estimated_error;
    std::optional<Interval> estimated_interval;
    std::optional<ErrorSources> error_sources;  // only if asked for
    std::string stopped_by;                     // "time", "error"; empty if neither did
    uint64_t peak_memory_bytes = 0;
    // Root of the relative mean squared error of the denoised picture, told by samples held out: of one that was made
    // without these.
    std::optional<double> denoised_error;
    std::optional<Interval> denoised_interval;
    bool partial = false;
    bool denoised = false;  // the picture; what the errors tell is of the noisy one

    uint64_t rays() const { return counters.camera_rays + counters.bounce_rays + counters.shadow_rays; }
};

// Indented, with "schema": "lancer.stats/1", ends in a newline.
std::string to_json(const RunStats& stats);

// 16 hexadecimal digits: JSON and EXR have no unsigned number of 64 bits.
std::string to_hex(uint64_t x);

}  // namespace lancer
