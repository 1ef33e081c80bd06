// Two settings beside each other: each half has the bits of its own render, and is timed alone.
#include <atomic>
#include <thread>

#include "app/view/split.h"
#include "app/view/turns.h"
#include "app/view_fixture.h"

namespace lancer {
namespace {

bool same_columns(const Image& a, const Image& b, int32_t begin, int32_t end)
{
    for (int32_t y = 0; y < a.data.height(); ++y)
        for (int32_t x = begin; x < end; ++x)
            if (!(a.at(x, y) == b.at(x, y))) return false;
    return true;
}

TEST_F(ViewTest, EachHalfHasTheBitsOfItsOwnRender)
{
    open("lit.toml", {48, 32}, 64);
    Sight other = sight_;
    other.settings.max_depth = 1;
    Split split(*session_, sight_);
    split.show(other);
    split.wait_until_idle();
    ShownPicture both;
    ASSERT_TRUE(split.take(both));
    EXPECT_FALSE(split.take(both));
    const auto render = [&](const std::string& name, const std::string& depth) {
        const Said said = run({"render", "lit.toml", "-q", "--size", "48x32", "-s", "64", "--replicates", "4",
                               "--max-depth", depth, "-o", name});
        EXPECT_EQ(said.code, 0) << said.err;
        return image(name);
    };
    const Image deep = render("deep.exr", "0"), shallow = render("shallow.exr", "1");
    EXPECT_TRUE(same_columns(both.image, deep, 0, 24));
    EXPECT_TRUE(same_columns(both.image, shallow, 24, 48));
    EXPECT_FALSE(same_columns(deep, shallow, 0, 24));
    split.move_to(0.75);
    ASSERT_TRUE(split.take(both));
    EXPECT_TRUE(same_columns(both.image, deep, 0, 36));
    EXPECT_TRUE(same_columns(both.image, shallow, 36, 48));
    const auto lines = split.lines();
    expect_words(lines.at(0), "left: max_depth 0");
    expect_words(lines.at(2), "right: max_depth 1");
    for (const size_t i : {1, 3}) expect_words(lines.at(i), "64 samples");
    EXPECT_GT(split.marks({48, 32}).size(), 4u) << "the line, and two curves";
}

// What it tells of its error is what a reference says. The scatter of four replicates over 1,536 pixels is known to a
// few per cent; twice the error would be a fault.
TEST_F(ViewTest, TheErrorBesideAnotherIsTheTrueOne)
{
    open("lit.toml", {48, 32}, 16);
    Split split(*session_, sight_);
    split.show(sight_);
    split.wait_until_idle();
    const auto course = session_->status().course;
    ASSERT_GE(course.size(), 3u);
    for (size_t i = 1; i < course.size(); ++i) EXPECT_GT(course[i].seconds, course[i - 1].seconds);
    EXPECT_LT(course.back().error, course.front().error);
    ShownPicture both;
    split.take(both);
    const Said said = run({"render", "lit.toml", "-q", "--size", "48x32", "-s", "4096", "--seed", "7", "-o", "r.exr"});
    ASSERT_EQ(said.code, 0) << said.err;
    const Image reference = image("r.exr");
    double sum = 0;
    const auto add = [&](float x, float r) { sum += double{x - r} * double{x - r} / (double{r} * double{r} + 0.01); };
    for (size_t i = 0; i < reference.pixels.size(); ++i) {
        const Color &x = both.image.pixels[i], &r = reference.pixels[i];
        add(x.r, r.r), add(x.g, r.g), add(x.b, r.b);
    }
    const double error = std::sqrt(sum / (3.0 * static_cast<double>(reference.pixels.size())));
    EXPECT_GT(course.back().error, 0.7 * error);
    EXPECT_LT(course.back().error, 1.4 * error);
}

TEST_F(ViewTest, WithoutTheSplitThePictureIsWhatItWas)
{
    open("lit.toml", {48, 32}, 16);
    const Image before = shown();
    key('B');
    set("max depth", 2);
    shown();
    key('B');
    const Image after = shown();
    EXPECT_EQ(after.pixels.size(), before.pixels.size());
    expect_rendered();
    set("max depth", 0);
    EXPECT_TRUE(same_pixels(before, shown()));
}

TEST_F(ViewTest, TheLineIsDraggedAndNothingElseMoves)
{
    open("lit.toml", {48, 32}, 4);
    key('B');
    const auto place_of_line = [&] {
        WindowFrame frame;
        hand().draw(picture_, frame);
        for (const Mark& m : frame.marks)
            if (m.kind == Mark::Kind::line && m.x0 == m.x1 && m.y0 == 0 && m.y1 == 32) return m.x0;
        return -1.0;
    };
    EXPECT_EQ(place_of_line(), 24);
    const CameraDescription camera = hand().sight().camera;
    drag(0, 25, 30, 37, 30);
    EXPECT_NEAR(place_of_line(), 37, 1e-9);
    EXPECT_TRUE(is_same_view(hand().sight().camera, camera));
    drag(0, 10, 30, 14, 30);
    EXPECT_FALSE(is_same_view(hand().sight().camera, camera));
}

// Also one that is getting ready: the other waits for it, however long it takes.
TEST(Turns, WhoHadLessTimeGoesNext)
{
    Turns turns;
    const int slow = 0, quick = 0;
    turns.take(&slow, 3, {});
    turns.take(&quick, 1, {});
    std::string order;  // whoever has the turn writes
    std::thread other([&] {
        const Turns::Turn turn = turns.take(&slow, 3, {});
        order += 's';
    });
    for (const double seconds : {1.0, 2.0}) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        const Turns::Turn turn = turns.take(&quick, seconds, {});
        order += 'q';
    }
    turns.leave(&quick);
    other.join();
    EXPECT_EQ(order, "qqs");
}

TEST(Turns, WhoIsStoppedGetsNone)
{
    Turns turns;
    const int me = 0, other = 0;
    const Turns::Turn mine = turns.take(&me, 0, {});
    std::stop_source stop;
    std::thread waits([&] { turns.take(&other, 0, stop.get_token()); });
    stop.request_stop();
    waits.join();
}

}  // namespace
}  // namespace lancer
