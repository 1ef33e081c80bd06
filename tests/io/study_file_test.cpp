// The studies that are shipped can be run: their files are read without a problem, and so are the scenes that they
// name.
#include "io/study_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

namespace lancer {
namespace {

TEST(StudyFile, ThoseShippedHaveNoProblems)
{
    size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(LANCER_SOURCE_DIR "/bench/studies")) {
        Diagnostics diagnostics;
        const StudyPlan plan = load_study_file(entry.path(), diagnostics);
        // Scenes of some are written by scripts that need what is not in this repository.
        try {
            diagnostics.throw_if_errors();
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::missing_input) << e.what();
            std::istringstream lines(e.what());
            for (std::string line; std::getline(lines, line);) {
                EXPECT_NE(line.find("no such file: "), std::string::npos) << line;
                EXPECT_TRUE(line.find("build/anchors/") != std::string::npos ||
                            line.find("build/rooms/") != std::string::npos)
                    << line;
            }
        }
        EXPECT_GE(plan.seeds, 6u) << "fewer rank nothing";
        ++count;
    }
    EXPECT_GE(count, 3u);
}

TEST(StudyFile, PeersLieBesideIt)
{
    Diagnostics diagnostics;
    const StudyPlan plan = load_study_file(LANCER_SOURCE_DIR "/bench/studies/whitted.toml", diagnostics);
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(plan.peers) / "run")) << plan.peers;
    EXPECT_EQ(plan.methods.back().peer, "povray");
    EXPECT_TRUE(plan.methods.front().peer.empty());
}

TEST(StudyFile, OptionsAreWordsAndFilesLieBesideIt)
{
    Diagnostics diagnostics;
    const StudyPlan plan = load_study_file(LANCER_SOURCE_DIR "/bench/studies/ladder.toml", diagnostics);
    ASSERT_EQ(plan.scenes.size(), 1u);
    EXPECT_EQ(plan.scenes[0].options, (std::vector<std::string>{"--size", "256x144", "--filter", "box"}));
    EXPECT_TRUE(std::filesystem::equivalent(plan.scenes[0].file, LANCER_SOURCE_DIR "/scenes/cornell.toml"));
    EXPECT_EQ(plan.methods.back().name, plan.baseline);
    EXPECT_TRUE(plan.methods.back().options.empty());
    EXPECT_EQ(plan.methods.front().time, 3) << "its own";
    EXPECT_EQ(plan.methods.back().time, 15) << "that of the study";
}

}  // namespace
}  // namespace lancer
