// Shared data of lancer study: the folder of a study, finished work, and results of runs.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/options/options.h"
#include "app/signals.h"
#include "core/image.h"
#include "io/study_file.h"
#include "report/study/results.h"

namespace lancer {

struct StudyWork {
    const StudyOptions& options;
    const StudyPlan& plan;
    Signals& signals;
    size_t started = 0;  // runs that were not done before

    std::string file(const std::string& name) const;  // in the folder of the study
};

// A file is finished if its mark has this key. The mark is written last.
bool is_done(const std::string& file, const std::string& key);
void unmark(const std::string& file);
void mark_done(const std::string& file, const std::string& key);

// The reference of a scene: two independent halves.
struct Reference {
    std::array<std::string, 2> files;
    std::array<Image, 2> halves;
    std::vector<std::string> limits;  // its ledger: what all methods that draw this scene share
    std::string hash;                 // of the scene
    bool box_filter = false;
};

Image mean_of(const Reference& reference);

// The last picture of a run.
struct LastPicture {
    std::string path;
    double spp = 0, seconds = 0;
};

struct RunResult {
    std::vector<StudyRun> runs;  // a peer's errors may be told against two references
    std::vector<std::string> biases;
    std::optional<LastPicture> picture;  // nothing of a run that failed
};

}  // namespace lancer
