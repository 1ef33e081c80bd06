// The session of lancer view, without a window: its pictures have the bits of lancer render, and a change rebuilds what
// it must, and no more.
#include <gtest/gtest.h>

#include "app/prepare.h"
#include "app/run_program.h"
#include "app/view/camera_moves.h"
#include "app/view/controller.h"
#include "core/parallel.h"

namespace lancer {
namespace {

class ViewTest : public AppTest {
protected:
    ViewTest() { write("lit.toml", lit_scene); }

    // Opens a scene of the folder as lancer view does. Options: as of render settings.
    void open(const std::string& name, PictureSize size, uint32_t spp, uint32_t threads = 2)
    {
        session_.reset();
        PictureOptions options;
        options.scene.file = file(name);
        options.render.give(&RenderSettings::size, size);
        options.render.give(&RenderSettings::spp, spp);
        options.threads = threads;
        Diagnostics diagnostics;
        prepared_ = load_prepared(options, diagnostics, true);
        std::unique_ptr<Renderer> renderer;
        with_threads(threads, [&] {
            begin_prepared(prepared_, diagnostics);
            renderer = make_renderer(prepared_, options, 256, diagnostics);
        });
        EditedScene document(options.scene, prepared_.added.text, prepared_.description, options.render,
                             prepared_.settings);
        sight_ = {*prepared_.description.camera, document.scene(), prepared_.settings};
        session_.emplace(SessionSetup{.renderer = std::move(renderer),
                                      .rebuild = {prepared_.images->source(), prepared_.memory},
                                      .threads = threads},
                         sight_);
        ControllerHost host{
            .print = [this](const std::string& text) { printed_ += text; },
            .say = [this](const std::string& text) { said_ += text + "\n"; },
            .copy = [this](const std::string& text) { copied_ = text; },
            .save_scene = [this](const std::string& text) { write("written.toml", text); },
            .save_over =
                [this](const std::string& text) {
                    std::filesystem::rename(file("lit.toml"), file("old.toml"));
                    write("lit.toml", text);
                    return file("old.toml");
                },
            .write_picture = [this](const Film& film, const Renderer&,
                                    const DisplayCurve&) { write_exr(file("view.exr"), to_image(film), {}); }};
        controller_ = std::make_unique<Controller>(*session_, std::move(document), sight_, DisplayCurve{}, KeyFrames{},
                                                   std::move(host));
    }
    Controller& hand() { return *controller_; }
    void key(int key, uint8_t mods = 0)
    {
        hand().handle({.kind = InputEvent::Kind::key_down, .key = key, .mods = mods});
        hand().handle({.kind = InputEvent::Kind::key_up, .key = key, .mods = mods});
    }
    void drag(int button, double x0, double y0, double x1, double y1, uint8_t mods = 0)
    {
        hand().handle({.kind = InputEvent::Kind::move, .x = x0, .y = y0});
        hand().handle({.kind = InputEvent::Kind::button_down, .key = button, .mods = mods, .x = x0, .y = y0});
        for (int i = 1; i <= 4; ++i)
            hand().handle({.kind = InputEvent::Kind::move,
                           .mods = mods,
                           .x = x0 + (x1 - x0) * i / 4,
                           .y = y0 + (y1 - y0) * i / 4});
        hand().handle({.kind = InputEvent::Kind::button_up, .key = button, .mods = mods, .x = x1, .y = y1});
    }
    Image shown()
    {
        session_->wait_until_idle();
        session_->take(picture_);
        return picture_.image;
    }
    // What the hand does to the widget of the panel with that label.
    void set(const std::string& label, double x, double y = 0, double z = 0)
    {
        WindowFrame frame;
        hand().draw(picture_, frame);
        const auto widget =
            std::find_if(frame.widgets.begin(), frame.widgets.end(), [&](const Widget& w) { return w.label == label; });
        ASSERT_NE(widget, frame.widgets.end()) << label;
        widget->value = {x, y, z};
        hand().change(*widget);
    }
    // That the complete picture is that of lancer render of the scene as it is written now.
    void expect_rendered(const std::vector<std::string>& more = {})
    {
        const Image view = shown();
        EXPECT_EQ(session_->status().problem, "");
        key('S', mod_control);
        std::vector<std::string> arguments{"render", "written.toml", "-q", "-o", "render.exr"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Said said = run(arguments);
        ASSERT_EQ(said.code, 0) << said.err << read_bytes(file("written.toml"));
        EXPECT_TRUE(same_pixels(view, image("render.exr"))) << read_bytes(file("written.toml"));
    }

    static constexpr const char* lit_scene = R"(version = 1
[camera]
position = [0, 1, 5]
target = [0, 0.5, 0]
[camera.left]
position = [-4, 1, 3]
[[plane]]
point = [0, 0, 0]
normal = [0, 1, 0]
material = "floor"
[[sphere]]
center = [0, 1, 0]
radius = 1
material = "ball"
[[light]]
type = "point"
position = [1.5, 2, 2]
intensity = [20, 18, 15]
[[light]]
type = "environment"
radiance = [0.2, 0.3, 0.4]
[material.floor]
base_color = [0.5, 0.5, 0.5]
[material.ball]
type = "metal"
base_color = [0.9, 0.6, 0.3]
roughness = 0.3
)";

    Prepared prepared_;
    Sight sight_;
    std::optional<Session> session_;
    std::unique_ptr<Controller> controller_;
    ShownPicture picture_;
    std::string printed_, said_, copied_;
};

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

TEST_F(ViewTest, ALightThatIsDraggedKeepsTheAccelerator)
{
    open("lit.toml", {64, 48}, 8);
    const auto handles = handles_of(*hand().document().scene(), hand().sight().camera, {64, 48});
    ASSERT_EQ(handles.size(), 1u);
    const Vec3d before = hand().document().scene()->lights[0].position;
    drag(0, handles[0].x, handles[0].y, handles[0].x - 20, handles[0].y + 6);
    const Vec3d after = hand().document().scene()->lights[0].position;
    EXPECT_LT(after.x, before.x - 0.5);
    EXPECT_LT(after.y, before.y - 0.1);
    // In the plane of the view: at the same depth.
    EXPECT_NEAR(depth_of(hand().sight().camera, after), depth_of(hand().sight().camera, before), 1e-12);
    const auto moved = handles_of(*hand().document().scene(), hand().sight().camera, {64, 48});
    EXPECT_NEAR(moved[0].x, handles[0].x - 20, 1e-3);
    EXPECT_NEAR(moved[0].y, handles[0].y + 6, 1e-3);
    hand().handle({.kind = InputEvent::Kind::wheel, .x = moved[0].x, .y = moved[0].y, .amount = 1});
    EXPECT_GT(depth_of(hand().sight().camera, hand().document().scene()->lights[0].position),
              1.05 * depth_of(hand().sight().camera, after));
    expect_rendered();
    EXPECT_GT(session_->status().scenes_built, 1u);
    EXPECT_EQ(session_->status().accelerators_built, 1u);
}

TEST_F(ViewTest, LightsAtInfinityCannotBeDragged)
{
    open("lit.toml", {64, 48}, 1);
    for (const Handle& h : handles_of(*hand().document().scene(), hand().sight().camera, {64, 48}))
        EXPECT_EQ(h.index, 0u);
}

TEST_F(ViewTest, MaterialsAndSpheresChangeWithWhatTheyNeed)
{
    open("lit.toml", {64, 48}, 8);
    hand().handle({.kind = InputEvent::Kind::button_down, .x = 32, .y = 20});
    hand().handle({.kind = InputEvent::Kind::button_up, .x = 32, .y = 20});
    ASSERT_TRUE(hand().picked());
    EXPECT_EQ(hand().picked()->material, "ball");
    EXPECT_EQ(hand().picked()->sphere, std::optional<size_t>(0));
    WindowFrame frame;
    const auto change = [&](const std::string& label, std::array<double, 3> value) {
        hand().draw(picture_, frame);
        for (Widget& w : frame.widgets)
            if (w.label == label) {
                w.value = value;
                return hand().change(w);
            }
        ADD_FAILURE() << "no widget " << label;
    };
    change("roughness", {0.1});
    change("base_color", {0.2, 0.5, 0.9});
    expect_rendered();
    EXPECT_EQ(session_->status().accelerators_built, 1u);
    change("center", {0.4, 1.2, -0.3});
    expect_rendered();
    EXPECT_EQ(session_->status().accelerators_built, 2u);
    change("fov", {55});
    change("type", {1});
    change("aperture", {0.1});
    change("focus", {4});
    expect_rendered();
    EXPECT_EQ(session_->status().accelerators_built, 2u);
}

TEST_F(ViewTest, LightsAreAddedAndMovedLikeThoseOfTheFile)
{
    open("lit.toml", {48, 32}, 2);
    const size_t before = hand().document().scene()->lights.size();
    for (size_t type = 0; type < 4; ++type) set("add", static_cast<double>(type + 1));
    ASSERT_EQ(hand().document().scene()->lights.size(), before + 4);
    EXPECT_EQ(hand().document().scene()->lights[before + 3].type, LightType::sphere);
    expect_rendered();
    set("radius", 0.3);  // of the one that was added last
    set("place", 1, 2, 0.5);
    expect_rendered();
    EXPECT_EQ(session_->status().accelerators_built, 3u) << "for the lamp, which is a sphere";
    key('X');
    expect_rendered();
}

TEST_F(ViewTest, AFileThatWasWrittenOverIsNotReadAgain)
{
    open("lit.toml", {48, 32}, 2);
    set("add", 1);
    const Image seen = shown();
    key('S', mod_control | mod_shift);
    EXPECT_EQ(run({"render", "lit.toml", "--size", "48x32", "-s", "2", "-q", "-o", "over.exr"}).code, 0);
    EXPECT_TRUE(same_pixels(seen, image("over.exr")));
    expect_rendered();  // the light is there once, as before
}

TEST_F(ViewTest, ASkyOfAPictureTurnsAndFades)
{
    Image sky;
    sky.data = sky.display = {0, 0, 16, 8};
    sky.pixels.resize(16 * 8);
    for (size_t i = 0; i < sky.pixels.size(); ++i) sky.pixels[i] = {static_cast<float>(i % 16), 1, 0.5f};
    write_exr(file("sky.exr"), sky, {});
    write("sky.toml",
          "[camera]\nposition = [0, 0, 4]\n[[sphere]]\n[[light]]\ntype = \"environment\"\nfile = \"sky.exr\"\n");
    open("sky.toml", {48, 32}, 2);
    const Image first = shown();
    set("light", 1);
    set("rotate", 0, 90, 0);
    const Image turned = shown();
    EXPECT_FALSE(same_pixels(first, turned));
    expect_rendered();
    set("power", 0.5, 0.5, 0.5);
    EXPECT_FALSE(same_pixels(turned, shown()));
    expect_rendered();
}

TEST_F(ViewTest, AnotherAcceleratorShowsTheSame)
{
    open("lit.toml", {48, 32}, 2);
    const Image first = shown();
    set("accelerator", static_cast<double>(AccelKind::list));
    EXPECT_TRUE(same_pixels(first, shown()));
    EXPECT_EQ(session_->status().accelerators_built, 2u);
    expect_rendered();
    EXPECT_NE(read_bytes(file("written.toml")).find("accel = \"list\""), std::string::npos);
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
