// A render shown in a viewer, and viewers that are not there, leave or do not read.
#include <gtest/gtest.h>

#include "app/run_program.h"
#include "io/mock_viewer.h"

namespace lancer {
namespace {

size_t count_of(const std::string& text, const std::string& word)
{
    size_t n = 0;
    for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
    return n;
}

class Shown : public AppTest {
protected:
    // The render with that viewer ends well, warns once, with these words, and has the pixels of one without.
    void expect_warning(const std::string& address, const std::string& words, const std::string& size = "24x16") const
    {
        const std::vector<std::string> all{"scene.toml", "--size", size, "-s", "1", "-q", "--strict", "-o"};
        std::vector<std::string> alone = all, shown = all;
        alone.emplace_back("alone.exr");
        shown.insert(shown.end(), {"shown.exr", "--stats", "s.json", "--display-server", address});
        ASSERT_EQ(run(alone).code, 0);
        const Said said = run(shown);
        EXPECT_EQ(said.code, 0) << said.err;
        expect_words(said.err, "lancer: warning: --display-server: ");
        expect_words(said.err, words);
        EXPECT_EQ(count_of(said.err, "\n"), 1u) << said.err;
        EXPECT_EQ(said.out, "shown.exr\n");
        EXPECT_TRUE(same_pixels(image("alone.exr"), image("shown.exr")));
        expect_words(read_bytes(file("s.json")), words);
    }
    // The viewer has the pixels of that picture, and nothing else.
    void expect_shown(MockViewer& viewer, const std::string& name) const
    {
        const Viewed& viewed = viewer.finish();
        EXPECT_EQ(viewed.fault, "");
        EXPECT_EQ(viewed.name, name);
        const Image written = image(name);
        ASSERT_TRUE(viewed.image.display == written.display);
        const int32_t width = written.display.width();
        for (int32_t y = 0; y < written.display.height(); ++y)
            for (int32_t x = 0; x < width; ++x) {
                const Window& w = written.data;
                const bool inside = x >= w.x0 && x < w.x1 && y >= w.y0 && y < w.y1;
                const uint32_t writes = viewed.writes[static_cast<size_t>(y * width + x)];
                ASSERT_EQ(writes > 0, inside) << x << ' ' << y;
                if (!inside) continue;
                const Color a = viewed.image.at(x, y), b = written.at(x, y);
                ASSERT_EQ(std::memcmp(&a, &b, sizeof a), 0) << x << ' ' << y;
            }
    }
};

TEST_F(Shown, InTheEndIsThePictureThatWasWritten)
{
    // One pass and several, also such that end within a block of samples, rows in one packet and in many, tiles that do
    // not divide the picture.
    const std::vector<std::vector<std::string>> cases{{"--size", "24x16", "-s", "1"},
                                                      {"--size", "50x31", "-s", "100", "--tile", "7"},
                                                      {"--size", "640x480", "-s", "1", "--tile", "100"},
                                                      {"--size", "64x48", "-s", "40", "--crop", "5,7,50,41"},
                                                      {"--size", "48x32", "-s", "200", "--set", "stop=true"},
                                                      {"--size", "48x32", "-s", "24", "--error", "1e-9"}};
    for (std::vector<std::string> arguments : cases) {
        arguments.insert(arguments.begin(), "scene.toml");
        arguments.insert(arguments.end(), {"-q", "-o", "alone.exr"});
        ASSERT_EQ(run(arguments).code, 0);
        MockViewer viewer;
        arguments.back() = "shown.exr";
        arguments.insert(arguments.end(), {"--display-server", viewer.address()});
        const Said said = run(arguments);
        EXPECT_EQ(said.code, 0);
        EXPECT_EQ(said.err, "");
        expect_shown(viewer, "shown.exr");
        EXPECT_TRUE(same_pixels(image("alone.exr"), image("shown.exr")));
    }
}

// States come while the render is under way, and an interrupted picture is shown as it was written.
TEST_F(Shown, WhileItGrows)
{
    MockViewer viewer;
    Program program(folder_, {"scene.toml", "-s", "2000000000", "--size", "32x32", "-o", "a.exr", "--display-server",
                              viewer.address()});
    ASSERT_TRUE(program.wait_for([&] { return viewer.updates() >= 3; }));
    program.send(SIGINT);
    EXPECT_EQ(program.wait().code, 130);
    expect_shown(viewer, "a.exr");
}

TEST_F(Shown, NobodyListens)
{
    const BoundSocket silent;
    expect_warning(silent.address(), "no viewer at " + silent.address() + ": Connection refused; start tev there");
}

// No label of a name may have more than 63 letters, so that this one is asked of nobody.
TEST_F(Shown, NamesThatDoNotResolve)
{
    const std::string name(64, 'a');
    expect_warning(name, "no viewer at " + name + ":14158: ");
}

// Said while the render goes on. Who closes at once may be gone before the picture is opened, or some time later.
TEST_F(Shown, AViewerThatLeavesIsSaidAtOnce)
{
    for (const Manner manner : {Manner::leaves_after_an_update, Manner::closes_at_once}) {
        MockViewer viewer(manner);
        Program program(folder_, {"scene.toml", "-s", "2000000000", "--size", "32x32", "-o", "a.exr", "--progress",
                                  "none", "--display-server", viewer.address()});
        if (manner == Manner::leaves_after_an_update) {
            ASSERT_TRUE(program.wait_for_message("lost the viewer at " + viewer.address() + " after "));
            expect_words(program.err(), " updates: it closed the connection; the files will have the rest");
        } else {
            ASSERT_TRUE(program.wait_for_message("it closed the connection"));
        }
        // Still rendering: a state that did not exist at the time of the warning.
        program.send(SIGUSR1);
        ASSERT_TRUE(program.wait_for_message("snapshot written"));
        program.send(SIGINT);
        const Said said = program.wait();
        EXPECT_EQ(said.code, 130);
        EXPECT_EQ(count_of(said.err, "--display-server"), 1u) << said.err;
        EXPECT_EQ(said.out, "a.exr\n");
        EXPECT_GT(image("a.exr").at(0, 0).b, 0);
    }
}

TEST_F(Shown, AViewerThatDoesNotRead)
{
    MockViewer viewer(Manner::never_reads);
    expect_warning(viewer.address(), "lost the viewer at " + viewer.address(), "1024x1024");
}

TEST_F(Shown, AddressesThatAreNone)
{
    const auto expect_usage = [&](const std::string& address, const std::string& words) {
        const Said said = render({"-o", "a.exr", "--display-server", address});
        EXPECT_EQ(said.code, 2) << address;
        expect_words(said.err, "--display-server: " + words);
        EXPECT_FALSE(exists("a.exr"));
    };
    for (const std::string address : {"", ":14158", "::1", "[::1", "[]", "[]:1", "[::1]1", "a:1:2", "fe80::1"})
        expect_usage(address, "'" + address + "' is not HOST or HOST:PORT");
    for (const std::string port : {"", "0", "65536", "-1", "1x", "//host"})
        for (const char* const host : {"localhost", "[::1]"})
            expect_usage(host + (":" + port), "'" + port + "' is not a whole number from 1 to 65535");
}

}  // namespace
}  // namespace lancer
