// What a study of error against run time is to render: a TOML file of scenes and methods. Every method draws every
// scene with every seed; see docs/measuring.md for its keys.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"

namespace lancer {

struct StudyPlan {
    struct Scene {
        std::string name, description, file;  // file: .toml, or a mesh
        std::vector<std::string> options;     // of lancer render
        uint32_t reference_spp = 4096;        // of each half of the reference
    };
    struct Method {
        std::string name, description;
        std::vector<std::string> options;  // of lancer render
        // Another renderer, by the name that bench/peers/run knows; empty: lancer. Then there are no options.
        std::string peer;
        bool throughput_only = false;       // its picture is not the scene's: never ranked
        uint32_t own_reference_spp = 1024;  // of each half of the reference that it draws for itself
        std::optional<double> time;         // seconds of rendering of each run: its own or the study's
    };

    std::string title, baseline;  // baseline: name of the method that others are held against
    uint32_t seeds = 8;
    // Of each run: seconds of rendering, samples per pixel, or whichever comes first. One of them is there.
    std::optional<double> time;
    std::optional<uint32_t> spp;
    std::string peers;          // folder of the script `run` that starts peers; empty if there are none
    double peer_timeout = 600;  // seconds after which a peer is stopped
    std::vector<Scene> scenes;
    std::vector<Method> methods;
};

// Collects every problem in `diagnostics`, and what is left out as warnings; after an error the plan is not fit for
// use. Throws Error only if the file cannot be read at all.
StudyPlan load_study_file(const std::string& path, Diagnostics& diagnostics);

}  // namespace lancer
