// Interrupts and snapshots of a running render, and what it maps.
#include <gtest/gtest.h>

#include "app/run_program.h"

namespace lancer {
namespace {

class Running : public AppTest {
protected:
    // Far more samples than any test waits for. Progress is said after every pass.
    const std::vector<std::string> endless_{"scene.toml", "-s",    "2000000000", "--size", "32x32",      "-o",  "a.exr",
                                            "-o",         "a.png", "--stats",    "s.json", "--progress", "json"};
};

TEST_F(Running, AnInterruptLeavesAPictureMarkedPartial)
{
    for (const int signal : {SIGINT, SIGTERM}) {
        Program program(folder_, endless_);
        ASSERT_TRUE(program.wait_for_message("\"spp\":16"));
        program.send(signal);
        const Said said = program.wait();
        EXPECT_EQ(said.code, 130) << said.err;
        expect_words(said.err, "interrupted: the pictures are partial");
        EXPECT_EQ(said.out, "a.exr\na.png\n");
        EXPECT_EQ(metadata("a.exr", "partial"), "1");
        EXPECT_GT(image("a.exr").at(0, 0).b, 0);
        expect_words(read_bytes(file("s.json")), "\"partial\": true");
    }
}

TEST_F(Running, ASnapshotIsWrittenWithoutStopping)
{
    Program program(folder_, endless_);
    ASSERT_TRUE(program.wait_for_message("\"spp\":16"));
    EXPECT_FALSE(exists("a.exr"));
    program.send(SIGUSR1);
    ASSERT_TRUE(program.wait_for_message("snapshot written"));
    EXPECT_EQ(metadata("a.exr", "partial"), "1");
    EXPECT_TRUE(exists("a.png"));
    EXPECT_EQ(kill(program.pid(), 0), 0);
}

// The second interrupt need not wait for a tile: one of a million pixels takes long.
TEST_F(Running, TheSecondInterruptEndsAtOnce)
{
    write("a.exr", "precious");
    Program program(folder_, {"scene.toml", "-s", "16", "--size", "1024x1024", "--tile", "1024", "-o", "a.exr", "-v"});
    ASSERT_TRUE(program.wait_for_message("--spp 16"));
    program.send(SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    program.send(SIGINT);
    EXPECT_EQ(program.wait().code, 130);
    EXPECT_EQ(read_bytes(file("a.exr")), "precious");
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"a.exr", "quad.obj", "scene.toml"}));
}

// Opening that library and what it brings along would cost more than a small render.
TEST_F(Running, WithoutTexturesOpenImageIOStaysOut)
{
    Program program(folder_, endless_);
    ASSERT_TRUE(program.wait_for_message("\"spp\":16"));
    const std::string maps = read_bytes("/proc/" + std::to_string(program.pid()) + "/maps");
    EXPECT_NE(maps.find("lancer"), std::string::npos);
    EXPECT_EQ(maps.find("OpenImageIO"), std::string::npos);
}

}  // namespace
}  // namespace lancer
