// What the hand changes of a scene in lancer view: what is written renders the same bits.
#include "app/view_fixture.h"

namespace lancer {
namespace {

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
    EXPECT_EQ(session_->status().accelerators_built, 2u) << "for the lamp, which is a sphere";
    // Each is waited for: of changes that come sooner, the session may build the last alone.
    set("radius", 0.3);  // of the one that was added last
    expect_rendered();
    EXPECT_EQ(session_->status().accelerators_built, 3u);
    set("place", 1, 2, 0.5);
    expect_rendered();
    EXPECT_EQ(session_->status().accelerators_built, 4u);
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

// As an override before those of the file, of which the one that has counted so far still does.
TEST_F(ViewTest, MaterialsOfMeshFilesChange)
{
    write("ball.mtl", "newmtl shiny [a]\nKd 0.6 0.5 0.4\nnewmtl dull\nKd 0.2 0.3 0.4\n");
    write("wall.obj",
          "mtllib ball.mtl\nv -4 0 0\nv 4 0 0\nv 4 4 0\nv -4 4 0\nv -4 -4 0\nv 4 -4 0\n"
          "usemtl shiny [a]\nf 1 2 3 4\nusemtl dull\nf 5 6 2 1\n");
    write(
        "wall.toml",
        "version = 1\n[camera] # of the wall\nposition = [0, 0, 9]\ntarget = [0, 0, 0]\n[[mesh]]\nfile = \"wall.obj\"\n"
        "[[light]]\ntype = \"environment\"\nradiance = 1\n"
        "# what the exporter got wrong\n[[material_override]]\nmatch = \"shiny*\"\ntype = \"metal\"\n"
        "roughness = 0.4 # measured\n");
    open("wall.toml", {48, 32}, 4);
    const Image first = shown();
    const auto click_at = [&](double x, double y) { drag(0, x, y, x, y); };
    click_at(24, 8);
    ASSERT_TRUE(hand().picked());
    ASSERT_EQ(hand().picked()->material, "shiny [a]");
    set("base_color", 0.9, 0.1, 0.2);
    const Image red = shown();
    EXPECT_FALSE(same_pixels(first, red));
    expect_rendered();
    set("roughness", 0.1);
    set("base_color", 0.1, 0.9, 0.2);
    EXPECT_FALSE(same_pixels(red, shown()));
    expect_rendered();
    click_at(24, 24);
    ASSERT_EQ(hand().picked()->material, "dull");
    set("base_color", 0.7, 0.1, 0.7);
    expect_rendered();
    const std::string written = read_bytes(file("written.toml"));
    for (const char* words : {"# of the wall", "# what the exporter got wrong\n", "# measured"})
        expect_words(written, words);
}

TEST_F(ViewTest, EverySwitchIsChosenByHand)
{
    open("lit.toml", {24, 16}, 2);
    const Image first = shown();
    set("switches", 1);
    set("indirect", 0);
    EXPECT_FALSE(same_pixels(first, shown()));
    expect_rendered();
    expect_words(read_bytes(file("written.toml")), "indirect = false");
    set("mis_compensation", 0);
    set("terminator", 1);
    expect_rendered();
    set("indirect", 1);
    expect_rendered();
}

}  // namespace
}  // namespace lancer
