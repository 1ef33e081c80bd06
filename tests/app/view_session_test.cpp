// The session of lancer view, without a window: its pictures have the bits of lancer render, and a change rebuilds what
// it must, and no more.
#include "app/view_fixture.h"

namespace lancer {
namespace {

TEST_F(ViewTest, ACompletePictureHasTheBitsOfARender)
{
    for (const uint32_t spp : {1u, 5u, 16u, 40u}) {
        open("lit.toml", {50, 31}, spp, spp % 3 + 1);
        expect_rendered();
        EXPECT_EQ(session_->status().samples, spp);
        EXPECT_TRUE(session_->status().is_complete);
    }
}

TEST_F(ViewTest, MovesOfTheCameraRebuildNothing)
{
    open("lit.toml", {64, 48}, 4);
    drag(0, 10, 40, 25, 35);
    drag(2, 10, 40, 14, 44);
    drag(1, 10, 40, 12, 41);
    hand().handle({.kind = InputEvent::Kind::wheel, .x = 5, .y = 40, .amount = 2});
    expect_rendered();
    EXPECT_FALSE(is_same_view(hand().sight().camera, *prepared_.description.camera));
    EXPECT_EQ(session_->status().scenes_built, 1u);
    EXPECT_EQ(session_->status().accelerators_built, 1u);
}

TEST_F(ViewTest, PathsOfAPixelAreLinesInTheScene)
{
    open("lit.toml", {48, 32}, 2);
    const auto lines = [&] {
        session_->wait_until_idle();
        WindowFrame frame;
        hand().draw(picture_, frame);
        std::vector<Mark> found;
        for (const Mark& m : frame.marks)
            if (m.kind == Mark::Kind::line) found.push_back(m);
        return found;
    };
    EXPECT_TRUE(lines().empty());
    hand().handle({.kind = InputEvent::Kind::move, .x = 24.5, .y = 20.5});
    key('I');
    const std::vector<Mark> seen = lines();
    ASSERT_GT(seen.size(), 16u) << "eight samples, with shadow rays";
    // The camera's rays are points in its own view: their ends are at the pixel.
    EXPECT_NEAR(seen[0].x1, 24.5, 1);
    EXPECT_NEAR(seen[0].y1, 20.5, 1);
    key('3');
    const std::vector<Mark> aside = lines();
    ASSERT_FALSE(aside.empty());
    EXPECT_GT(std::hypot(aside[0].x1 - aside[0].x0, aside[0].y1 - aside[0].y0), 10) << "from the side a ray is long";
    key('I');
    EXPECT_TRUE(lines().empty());
}

TEST_F(ViewTest, DepthKeysStayFromOneToTwenty)
{
    open("lit.toml", {24, 16}, 2);
    EXPECT_EQ(hand().sight().settings.max_depth, 0u);
    key('D');
    EXPECT_EQ(said_, "Max depth is 20\n");
    key('D');
    EXPECT_EQ(hand().sight().settings.max_depth, 20u);
    for (int i = 0; i < 25; ++i) key('D', mod_shift);
    EXPECT_EQ(hand().sight().settings.max_depth, 1u);
    expect_words(said_, "Max depth is 1\n");
    key('D');
    expect_words(said_, "Max depth is 2\n");
    expect_rendered();
    EXPECT_EQ(session_->status().scenes_built, 1u);
}

TEST_F(ViewTest, StillsHaveTheBitsOfARenderOfTheirSize)
{
    open("lit.toml", {80, 48}, 20);
    key('S', mod_control);
    const std::vector<std::pair<uint8_t, std::string>> cases{{0, "10x6"}, {mod_shift, "40x24"}, {mod_control, "80x48"}};
    for (const auto& [mods, size] : cases) {
        std::filesystem::remove(file("view.exr"));
        key('R', mods);
        session_->wait_until_idle();
        EXPECT_EQ(session_->status().problem, "");
        const Said said = run({"render", "written.toml", "-q", "--size", size, "-o", "render.exr"});
        ASSERT_EQ(said.code, 0) << said.err;
        EXPECT_TRUE(same_pixels(image("view.exr"), image("render.exr"))) << size;
    }
    expect_rendered();
}

TEST_F(ViewTest, KeyFramesAreRestoredAndPlayed)
{
    open("lit.toml", {24, 16}, 1);
    const CameraDescription first = hand().sight().camera;
    key(key_f1, mod_alt);
    drag(0, 4, 12, 12, 12);
    const CameraDescription second = hand().sight().camera;
    key(key_f1 + 11, mod_alt);
    EXPECT_TRUE(hand().has_new_frames());
    key(key_f1);
    EXPECT_TRUE(is_same_view(hand().sight().camera, first));
    key(key_f1 + 11);
    EXPECT_TRUE(is_same_view(hand().sight().camera, second));
    key(key_f1 + 5);
    expect_words(said_, "there is no key frame F6");
    hand().tick(10);
    key('P');
    hand().tick(11);
    const Vec3d middle = hand().sight().camera.position;
    EXPECT_TRUE(hand().is_moving());
    EXPECT_LT(length(middle - (first.position + second.position) * 0.5), 1e-9);
    hand().tick(12.5);
    EXPECT_FALSE(hand().is_moving());
    EXPECT_TRUE(is_same_view(hand().sight().camera, second));
    KeyFrames read;
    read.read(hand().key_frames().text(), "path.toml");
    EXPECT_EQ(read.text(), hand().key_frames().text());
    EXPECT_TRUE(is_same_view(*read.at(11), second));
}

TEST_F(ViewTest, APathGoesThroughItsFramesWithoutCorners)
{
    KeyFrames frames;
    for (uint32_t i = 0; i < 5; ++i) {
        CameraDescription c;
        c.position = {std::cos(1.0 * i), 0.1 * i, std::sin(1.0 * i)};
        frames.define(2 * i, c);
    }
    for (uint32_t i = 0; i < 5; ++i) EXPECT_TRUE(is_same_view(frames.along(i), *frames.at(2 * i)));
    const double h = 1e-6;
    for (const double t : {1.0, 2.0, 3.0}) {
        const Vec3d before = (frames.along(t).position - frames.along(t - h).position) / h;
        const Vec3d after = (frames.along(t + h).position - frames.along(t).position) / h;
        EXPECT_LT(length(before - after), 1e-4);
        // Catmull and Rom: along the chord of its neighbours.
        const Vec3d chord = (frames.along(t + 1).position - frames.along(t - 1).position) * 0.5;
        EXPECT_LT(length(after - chord), 1e-4);
    }
}

TEST_F(ViewTest, ThePrintedCameraGivesTheSamePicture)
{
    open("lit.toml", {32, 24}, 2);
    drag(0, 4, 20, 9, 17);
    key('C');
    EXPECT_EQ(printed_, copied_);
    const Image view = shown();
    const std::string scene = lit_scene, rest = scene.substr(scene.find("[[plane]]"));
    write("pasted.toml", "version = 1\n" + printed_ + rest);
    ASSERT_EQ(run({"render", "pasted.toml", "-q", "--size", "32x24", "-s", "2", "-o", "render.exr"}).code, 0);
    EXPECT_TRUE(same_pixels(view, image("render.exr")));
}

TEST_F(ViewTest, OfMovesThatComeFastTheLastOneIsShown)
{
    open("lit.toml", {96, 64}, 4);
    for (int i = 0; i < 200; ++i) {
        hand().handle({.kind = InputEvent::Kind::wheel, .x = 5, .y = 60, .amount = i % 2 ? 1.0 : -0.9});
        if (i % 20 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(7));
    }
    expect_rendered();
    EXPECT_EQ(session_->status().sight, hand().shown_number());
}

TEST_F(ViewTest, ItEndsAndChangesWhileItRenders)
{
    open("lit.toml", {640, 480}, 100000);
    const auto begin = std::chrono::steady_clock::now();
    while (session_->status().samples < 2) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const auto asked = std::chrono::steady_clock::now();
    const uint64_t sight = session_->show(hand().sight());
    sight_.camera.fov_deg = 30;
    const uint64_t other = session_->show(sight_);
    EXPECT_GT(other, sight);
    while (!session_->take(picture_) || picture_.sight != other) std::this_thread::yield();
    const auto seen = std::chrono::steady_clock::now();
    session_.reset();
    const auto ended = std::chrono::steady_clock::now();
    (void)begin;
    // Hundreds of times what it takes on an idle machine.
    EXPECT_LT(std::chrono::duration<double>(seen - asked).count(), 10);
    EXPECT_LT(std::chrono::duration<double>(ended - seen).count(), 10);
}

TEST_F(ViewTest, OtherPicturesOfTheSameFilm)
{
    open("lit.toml", {32, 24}, 8);
    const Image light = shown();
    std::vector<Image> all{light};
    for (size_t i = 1; i < enum_names<ShownAs>.size(); ++i) {
        key('V');
        all.push_back(shown());
        for (size_t k = 0; k + 1 < all.size(); ++k) EXPECT_FALSE(same_pixels(all[k], all.back())) << k << ' ' << i;
    }
    for (const Color& c : all[2].pixels) ASSERT_EQ(c.r, 1);  // samples: all of them
    key('V');
    EXPECT_TRUE(same_pixels(shown(), light));
}

// Nearer to the picture of many samples than what it is made of, and as good after its camera has come back.
TEST_F(ViewTest, ADenoisedPictureHasLessNoise)
{
    open("lit.toml", {64, 48}, 16);
    const Image noisy = shown();
    sight_.shown = ShownAs::denoised;
    session_->show(sight_);
    const Image denoised = shown();
    Sight other = sight_;
    other.camera.position.x += 1;
    session_->show(other);
    session_->show(sight_);
    EXPECT_TRUE(same_pixels(shown(), denoised));
    sight_.shown = ShownAs::light, sight_.settings.spp = 1024;
    session_->show(sight_);
    const Image reference = shown();
    const auto error = [&](const Image& image) {  // relative
        double sum = 0;
        for (size_t i = 0; i < image.pixels.size(); ++i) {
            const double x = luminance(image.pixels[i]), r = luminance(reference.pixels[i]);
            sum += (x - r) * (x - r) / (r * r + 0.01);
        }
        return sum;
    };
    EXPECT_LT(error(denoised), 0.5 * error(noisy));
}

TEST_F(ViewTest, EveryKeyHasOneAction)
{
    for (const KeyBinding& a : key_bindings()) {
        const auto action = action_of(a.key, a.mods);
        ASSERT_TRUE(action);
        EXPECT_EQ(action->action, a.action) << a.name;
        EXPECT_NE(key_help().find(a.help), std::string::npos);
    }
    EXPECT_EQ(action_of(key_f1 + 11, mod_alt)->frame, 11u);
    EXPECT_FALSE(action_of(key_f1 + 12, 0));
    EXPECT_FALSE(action_of('R', mod_alt));
}

}  // namespace
}  // namespace lancer
