// Runs of other renderers (peers) for a study, through the script bench/peers/run. A peer renders pictures at doubling
// sample counts and reports their times; their errors are computed here, in the rows of lancer's error log.
#pragma once

#include <map>

#include "app/study/work.h"
#include "report/study/peer.h"

namespace lancer {

// The method name for errors of a peer against its own reference.
std::string own_name(const std::string& method);

// A method that is a peer, on all scenes of a study.
class PeerMethod {
public:
    // Queries the peer. Throws Error (invalid_input) if the script does not know it.
    PeerMethod(StudyWork& work, const StudyPlan::Method& method);

    const std::string& version() const { return about_.version; }
    bool has_own_reference() const { return about_.seeds && !method_.throughput_only; }

    // Measures its speed on a scene and renders its own reference. `known` gets the reason if it is left out or not
    // ranked, `own` its own reference. Not valid after an interrupt.
    void prepare(const StudyPlan::Scene& scene, const Reference& reference, MethodOnScene& known, MethodOnScene& own);

    // Renders a run unless it exists. The first result is against the scene's reference, a second one against its own.
    // Nothing after an interrupt.
    std::optional<RunResult> run(const StudyPlan::Scene& scene, uint64_t seed, const Reference& reference);

private:
    struct OnScene {
        std::string size;               // as --size has it; empty: that of the scene
        std::string problem;            // why every run fails
        std::vector<uint32_t> samples;  // of the pictures of a run
        std::optional<Reference> own;   // its files and halves
    };
    struct Order {
        std::string name;  // of its files, without their ends
        std::vector<uint32_t> samples;
        uint64_t seed = 0;
    };
    struct Outcome {
        bool refused = false;
        std::string problem;  // empty: done
        std::vector<PeerRecord> records;
    };

    std::string picture(const std::string& name, uint32_t spp) const;
    // A key of everything that affects the result of an order.
    std::string key_of(const Reference& reference, const OnScene& on, const Order& order) const;
    Outcome start(const StudyPlan::Scene& scene, const OnScene& on, const Order& order);
    void choose_samples(const StudyPlan::Scene& scene, const Reference& reference, OnScene& on, MethodOnScene& known);
    void draw_own_reference(const StudyPlan::Scene& scene, const Reference& reference, OnScene& on, MethodOnScene& own);

    StudyWork& work_;
    const StudyPlan::Method& method_;
    std::string script_;
    std::string missing_, problem_;  // why it cannot be had at all; why every run fails
    PeerAbout about_;
    std::map<std::string, OnScene> scenes_;
};

}  // namespace lancer
