// Packets to a viewer, and viewers that are not there, leave or do not read. SIGPIPE is not ignored here: it would end
// the test program.
#include "io/net/display_server.h"

#include <gtest/gtest.h>

#include <limits>

#include "io/mock_viewer.h"

namespace lancer {
namespace {

using std::chrono::milliseconds;

// Long enough for any machine, short enough to tell from waiting for ever.
constexpr auto patience = std::chrono::seconds(30);

std::vector<Color> some_pixels(size_t count)
{
    std::vector<Color> pixels(count);
    for (size_t i = 0; i < count; ++i) {
        const auto x = static_cast<float>(i);
        pixels[i] = {x, -0.1f * x, 1 / (x + 1)};
    }
    return pixels;
}

TEST(DisplayServer, PutsRegionsInTheirPlace)
{
    MockViewer viewer;
    const Window windows[] = {{1, 2, 4, 3}, {0, 0, 5, 1}, {4, 3, 5, 4}};
    Image expected = make_image(5, 4);
    {
        DisplayServer server;
        ASSERT_EQ(server.connect("127.0.0.1", viewer.port()), "");
        ASSERT_EQ(server.create("the name", 5, 4), "");
        for (const Window& w : windows) {
            std::vector<Color> pixels = some_pixels(w.area());
            pixels[0].r = std::numeric_limits<float>::infinity();
            ASSERT_EQ(server.update(w, pixels), "");
            for (int32_t y = w.y0; y < w.y1; ++y)
                for (int32_t x = w.x0; x < w.x1; ++x)
                    expected.at(x, y) = pixels[static_cast<size_t>((y - w.y0) * w.width() + x - w.x0)];
        }
    }
    const Viewed& viewed = viewer.finish();
    EXPECT_EQ(viewed.fault, "");
    EXPECT_EQ(viewed.name, "the name");
    EXPECT_EQ(viewed.creates, 1u);
    EXPECT_EQ(viewed.updates, std::size(windows));
    EXPECT_TRUE(viewed.image.display == expected.display);
    EXPECT_TRUE(viewed.image.pixels == expected.pixels);
}

// The bytes themselves, worked out by hand from the description of the protocol.
TEST(DisplayServer, SendsTheseBytes)
{
    MockViewer viewer;
    {
        DisplayServer server;
        ASSERT_EQ(server.connect("127.0.0.1", viewer.port()), "");
        ASSERT_EQ(server.create("ab", 258, 3), "");
        ASSERT_EQ(server.update({256, 1, 257, 2}, std::vector<Color>{{1, 2, -0.5f}}), "");
    }
    const std::string channels("\3\0\0\0R\0G\0B\0", 10);
    const std::string create = std::string("\x1b\0\0\0\4\1ab\0", 9) + std::string("\2\1\0\0\3\0\0\0", 8) + channels;
    const std::string update = std::string("\x5f\0\0\0\6\0ab\0", 9) + channels +
                               std::string("\0\1\0\0\1\0\0\0\1\0\0\0\1\0\0\0", 16) +
                               std::string("\0\0\0\0\0\0\0\0\1\0\0\0\0\0\0\0\2\0\0\0\0\0\0\0", 24) +
                               std::string("\3\0\0\0\0\0\0\0\3\0\0\0\0\0\0\0\3\0\0\0\0\0\0\0", 24) +
                               std::string("\0\0\x80\x3f\0\0\0\x40\0\0\0\xbf", 12);
    EXPECT_EQ(viewer.finish().bytes, create + update);
}

TEST(DisplayServer, FindsHostsByName)
{
    MockViewer viewer;
    {
        DisplayServer server;
        EXPECT_EQ(server.connect("localhost", viewer.port()), "");
        EXPECT_EQ(server.create("a", 1, 1), "");
    }
    EXPECT_EQ(viewer.finish().creates, 1u);
}

TEST(DisplayServer, NobodyListens)
{
    const BoundSocket silent;
    DisplayServer server;
    EXPECT_EQ(server.connect("127.0.0.1", silent.port()), "Connection refused");
    EXPECT_EQ(server.create("a", 1, 1), "it is not connected");
}

// No label of a name may have more than 63 letters, so that this one is asked of nobody.
TEST(DisplayServer, NamesThatDoNotResolve)
{
    const auto start = std::chrono::steady_clock::now();
    EXPECT_NE(DisplayServer().connect(std::string(64, 'a'), 14158), "");
    EXPECT_LT(std::chrono::steady_clock::now() - start, patience);
}

// A listener that accepts nobody, with its queue full: connecting would take minutes.
TEST(DisplayServer, ConnectingHasATimeLimit)
{
    const BoundSocket busy;
    ASSERT_EQ(listen(busy.get(), 0), 0);
    TcpConnection first;
    ASSERT_EQ(first.connect("127.0.0.1", busy.port(), patience), "");
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(DisplayServer(milliseconds(50)).connect("127.0.0.1", busy.port()), "no answer in time");
    EXPECT_LT(std::chrono::steady_clock::now() - start, patience);
}

TEST(DisplayServer, AViewerThatLeaves)
{
    MockViewer viewer(Manner::closes_at_once);
    DisplayServer server;
    ASSERT_EQ(server.connect("127.0.0.1", viewer.port()), "");
    viewer.wait_for_close();
    EXPECT_EQ(server.create("a", 1, 1), "it closed the connection");
    EXPECT_EQ(server.update({0, 0, 1, 1}, some_pixels(1)), "it is not connected");
}

// While a packet is on its way: more than the system keeps.
TEST(DisplayServer, AViewerThatLeavesInTheMiddle)
{
    const BoundSocket listener;
    ASSERT_EQ(listen(listener.get(), 1), 0);
    DisplayServer server(patience);
    ASSERT_EQ(server.connect("127.0.0.1", listener.port()), "");
    std::thread leaves([&] {
        const int connection = accept(listener.get(), nullptr, nullptr);
        char some[1000];
        recv(connection, some, sizeof some, MSG_WAITALL);
        close(connection);
    });
    EXPECT_EQ(server.update({0, 0, 2048, 2048}, some_pixels(2048 * 2048)), "it closed the connection");
    leaves.join();
}

TEST(DisplayServer, AViewerThatDoesNotRead)
{
    MockViewer viewer(Manner::never_reads);
    DisplayServer server(milliseconds(50));
    ASSERT_EQ(server.connect("127.0.0.1", viewer.port()), "");
    ASSERT_EQ(server.create("a", 2048, 2048), "");
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(server.update({0, 0, 2048, 2048}, some_pixels(2048 * 2048)), "it does not read");
    EXPECT_LT(std::chrono::steady_clock::now() - start, patience);
    EXPECT_EQ(server.update({0, 0, 1, 1}, some_pixels(1)), "it is not connected");
}

}  // namespace
}  // namespace lancer
