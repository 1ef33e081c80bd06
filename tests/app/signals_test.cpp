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

TEST_F(Running, ASnapshotThatCannotBeWrittenEndsNothing)
{
    std::filesystem::create_directory(file("out"));
    Program program(folder_, {"scene.toml", "-s", "2000000000", "--size", "32x32", "-o", "out/a.exr", "--checkpoint",
                              "c.lancer", "--progress", "json"});
    ASSERT_TRUE(program.wait_for_message("\"spp\":16"));
    std::filesystem::rename(file("out"), file("gone"));
    program.send(SIGUSR1);
    ASSERT_TRUE(program.wait_for_message("goes on without this snapshot"));
    std::filesystem::create_directory(file("out"));
    program.send(SIGTERM);
    EXPECT_EQ(program.wait().code, 75);
    EXPECT_TRUE(exists("out/a.exr"));
}

// The folder is taken away while the picture is rendered.
TEST_F(Running, APictureThatCannotBeWrittenIsRescued)
{
    for (const char* const folder : {"out", "spare"}) std::filesystem::create_directory(file(folder));
    write("spare/a-rescued.exr", "precious");
    Program program(folder_,
                    {"scene.toml", "-s", "2000000000", "--size", "32x32", "-o", "out/a.exr", "-o", "b.png", "--stats",
                     "out/s.json", "--progress", "json"},
                    {"TMPDIR=" + file("spare")});
    ASSERT_TRUE(program.wait_for_message("\"spp\":16"));
    std::filesystem::rename(file("out"), file("gone"));
    program.send(SIGTERM);
    const Said said = program.wait();
    EXPECT_EQ(said.code, 1) << said.err;
    expect_words(said.err, "out/a.exr: error: cannot write");
    expect_words(said.err, "out/s.json: error: cannot write");
    expect_words(said.err, "interrupted: the pictures are partial");
    EXPECT_EQ(said.out, file("spare/a-rescued-2.exr") + "\nb-rescued.png\n");
    EXPECT_EQ(read_bytes(file("spare/a-rescued.exr")), "precious");
    EXPECT_GT(image("spare/a-rescued-2.exr").at(0, 0).b, 0);
    EXPECT_TRUE(exists("b-rescued.png"));
}

// A pass of eight samples of a million pixels is under way long before it ends: the snapshot has less.
TEST_F(Running, ASnapshotNeedNotWaitForThePass)
{
    Program program(folder_, {"scene.toml", "-s", "2000000000", "--size", "1024x1024", "-o", "a.exr"});
    ASSERT_TRUE(program.wait_for([&] { return program.catches(SIGUSR1); }));
    program.send(SIGUSR1);
    ASSERT_TRUE(program.wait_for_message("snapshot written"));
    EXPECT_EQ(metadata("a.exr", "partial"), "1");
    EXPECT_EQ(metadata("a.exr", "spp_done"), "0");
}

// The only pass is the last one. The picture is none the worse for having been written before.
TEST_F(Running, ASnapshotIsWrittenInTheLastPassToo)
{
    const std::vector<std::string> arguments{"scene.toml", "-s", "1", "--size", "1024x1024", "-o", "a.exr"};
    Program program(folder_, arguments);
    ASSERT_TRUE(program.wait_for([&] { return program.catches(SIGUSR1); }));
    program.send(SIGUSR1);
    const Said said = program.wait();
    EXPECT_EQ(said.code, 0);
    expect_words(said.err, "snapshot written");
    EXPECT_EQ(metadata("a.exr", "partial"), "0");
    const Image interrupted = image("a.exr");
    ASSERT_EQ(run(arguments).code, 0);
    EXPECT_TRUE(same_pixels(interrupted, image("a.exr")));
}

// The checkpoint is there before the picture is denoised, which takes a second and more.
TEST_F(Running, AnInterruptDoesNotWaitForTheDenoiser)
{
    const std::vector<std::string> arguments{"scene.toml", "-s",           "2", "--size",   "900x700", "-o", "a.exr",
                                             "--denoise",  "--checkpoint", "c", "--resume", "auto"};
    Program program(folder_, arguments);
    ASSERT_TRUE(program.wait_for([&] { return exists("c"); }));
    program.send(SIGINT);
    const Said said = program.wait();
    EXPECT_EQ(said.code, 75);
    expect_words(said.err, "not denoised");
    EXPECT_EQ(metadata("a.exr", "partial"), "1");
    const Said again = run(arguments);
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(metadata("a.exr", "partial"), "0");
    EXPECT_EQ(metadata("a.exr", "bias"), "denoised");
}

// The second interrupt need not wait for a tile: one of a million pixels takes long.
TEST_F(Running, TheSecondInterruptEndsAtOnce)
{
    for (const int second : {SIGINT, SIGTERM}) {
        write("a.exr", "precious");
        Program program(
            folder_, {"scene.toml", "-s", "2000000000", "--size", "1024x1024", "--tile", "1024", "-o", "a.exr", "-v"});
        ASSERT_TRUE(program.wait_for_message("--spp 2000000000"));
        program.send(SIGINT);
        // Two of a kind that wait together are one.
        ASSERT_TRUE(program.wait_for([&] { return !program.has_pending(SIGINT); }));
        program.send(second);
        EXPECT_EQ(program.wait().code, 130);
        EXPECT_EQ(read_bytes(file("a.exr")), "precious");
        EXPECT_EQ(folder_.names(), (std::vector<std::string>{"a.exr", "quad.obj", "scene.toml"}));
    }
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
