// lancer film: its frames are single renders of these frames, whatever draws them and however often it is stopped.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/run_program.h"
#include "io/image/png.h"

namespace lancer {
namespace {

// Camera, light, material, sphere and instance move; for some frames only the camera does.
const char* const moving = R"(
[[mesh]]
name = "quad"
file = "quad.obj"
[[instance]]
mesh = "quad"
translate = [-2, 0, 0]
[material.ball]
type = "plastic"
[camera.side]
position = [4, 2, 4]
[camera.near]
position = [1, 1, 3]
fov = 50
[animation]
frames = [1, 8]
fps = 12
[[animation.track]]
key = "camera"
frames = [1, 5, 8]
values = ["side", "near", { position = [-3, 1, 4], target = [0, 0.5, 0], fov = 45 }]
[[animation.track]]
key = "light.0.radiance"
frames = [4, 6]
values = [[20, 18, 15], [5, 5, 30]]
[[animation.track]]
key = "material.ball.roughness"
frames = [4, 6]
values = [0.1, 0.6]
interpolation = "smooth"
[[animation.track]]
key = "sphere.0.center"
frames = [6, 8]
values = [[0, 1, 0], [0, 1.5, -1]]
[[animation.track]]
key = "instance.0.rotate"
frames = [7, 8]
values = [[0, 0, 0], [0, 90, 0]]
)";

class Filmed : public AppTest {
protected:
    Filmed()
    {
        std::string scene = small_scene;
        scene.replace(scene.find("radius = 1\n"), 11, "radius = 1\nmaterial = \"ball\"\n");
        write("film.toml", scene + moving);
    }
    Said film(const Arguments& more) const
    {
        return run(Arguments{"film", "film.toml", "--size", "24x16", "-s", "4", "-o", "f.#.exr"} + more);
    }
    Image frame_alone(const std::string& number, const Arguments& more = {}) const
    {
        const Said said = run(
            Arguments{"render", "film.toml", "--size", "24x16", "-s", "4", "-q", "--frame", number, "-o", "alone.exr"} +
            more);
        EXPECT_EQ(said.code, 0) << said.err;
        return image("alone.exr");
    }
    void remove(const std::string& name) const { std::filesystem::remove(file(name)); }
    static std::string numbered(int k) { return "f." + std::to_string(k) + ".exr"; }
};

TEST_F(Filmed, FramesAreSingleRenders)
{
    const Said said = film({"--threads", "3"});
    ASSERT_EQ(said.code, 0) << said.err;
    EXPECT_EQ(said.out, "f.1.exr\nf.2.exr\nf.3.exr\nf.4.exr\nf.5.exr\nf.6.exr\nf.7.exr\nf.8.exr\n");
    for (int k = 1; k <= 8; ++k)
        EXPECT_TRUE(same_pixels(image(numbered(k)), frame_alone(std::to_string(k), {"--threads", "1"}))) << k;
    for (int k = 2; k <= 8; ++k) EXPECT_FALSE(same_pixels(image(numbered(k)), image(numbered(k - 1)))) << k;
    // The first frame is the default; a scene without film is not changed by having one.
    ASSERT_EQ(run({"render", "film.toml", "--size", "24x16", "-s", "4", "-q", "-o", "first.exr"}).code, 0);
    EXPECT_TRUE(same_pixels(image("first.exr"), image("f.1.exr")));
}

TEST_F(Filmed, EveryAcceleratorAndIntegratorKeepsThem)
{
    for (const Arguments& way : {Arguments{"--accel", "bvh8"},
                                 {"--accel", "list"},
                                 {"--integrator", "whitted"},
                                 {"--denoise", "-s", "8"},
                                 {"--legacy"}}) {
        ASSERT_EQ(film(way + Arguments{"--again", "-q", "--frames", "6-8"}).code, 0) << way[1];
        EXPECT_TRUE(same_pixels(image("f.7.exr"), frame_alone("7", way))) << way.back();
    }
}

// With the same bytes, so that a frame may come from anywhere.
TEST_F(Filmed, FilesAreThoseOfSingleRenders)
{
    ASSERT_EQ(film({"--reproducible", "--frames", "3-5", "--aov", "albedo", "-o", "f.#.png"}).code, 0);
    frame_alone("4", {"--reproducible", "--aov", "albedo", "-o", "alone.png"});
    EXPECT_TRUE(read_bytes(file("f.4.exr")) == read_bytes(file("alone.exr")));
    EXPECT_TRUE(read_bytes(file("f.4.png")) == read_bytes(file("alone.png")));
    const Said verified = run({"verify", "f.4.exr", "film.toml", "--pixels", "all"});
    EXPECT_EQ(verified.code, 0) << verified.err << verified.out;
}

TEST_F(Filmed, ShardsDealTheFrames)
{
    for (const char* const shard : {"2/3", "3/3", "1/3"}) ASSERT_EQ(film({"--shard", shard, "-q"}).code, 0);
    const Said second = film({"--shard", "2/3", "--again"});
    EXPECT_EQ(second.out, "f.2.exr\nf.5.exr\nf.8.exr\n");
    for (const char* const number : {"1", "5", "8"})
        EXPECT_TRUE(same_pixels(image("f." + std::string(number) + ".exr"), frame_alone(number)));
    const Said all = film({});
    EXPECT_EQ(all.out, "");
    expect_words(all.err, "0 frames drawn, 8 were there");
}

TEST_F(Filmed, FinishedFramesAreNotDrawnAgain)
{
    ASSERT_EQ(film({"-q"}).code, 0);
    remove("f.3.exr");
    write("f.4.exr", "something else");
    EXPECT_EQ(film({}).out, "f.3.exr\nf.4.exr\n");
    EXPECT_EQ(film({"--frames", "2-3", "--again"}).out, "f.2.exr\nf.3.exr\n");
    // What would be another picture, or another file, is drawn.
    for (const Arguments& other : {Arguments{"-s", "5"},
                                   {"--seed", "2"},
                                   {"--half"},
                                   {"--aov", "depth"},
                                   {"-D", "camera.fov=31"},
                                   {"--crop", "0,0,8,8"},
                                   {"--max-depth", "3"}}) {
        EXPECT_EQ(film(other + Arguments{"--frames", "2-2"}).out, "f.2.exr\n") << other[0];
        EXPECT_EQ(film(other + Arguments{"--frames", "2-2"}).out, "") << other[0];
    }
    EXPECT_EQ(film({"--frames", "2-2"}).out, "f.2.exr\n");
    for (const Arguments& same : {Arguments{"--threads", "1"}, {"--tile", "8"}, {"--accel", "list"}})
        EXPECT_EQ(film(same + Arguments{"--frames", "2-2"}).out, "") << same[0];
    // A second kind of picture makes a frame unfinished.
    EXPECT_EQ(film({"--frames", "2-2", "-o", "f.#.png"}).out, "f.2.exr\nf.2.png\n");
    EXPECT_EQ(film({"--frames", "2-2", "-o", "f.#.png"}).out, "");
    EXPECT_EQ(film({"--frames", "2-2", "-o", "f.#.png", "--exposure", "1"}).out, "f.2.exr\nf.2.png\n");
    const std::string text = read_bytes(file("film.toml"));
    write("film.toml", text + "# another file\n");
    EXPECT_EQ(film({"--frames", "2-2"}).out, "f.2.exr\n");
}

// Killed between frames or within one, then stopped by a signal, then left alone.
TEST_F(Filmed, GoesOnWhereItWasStopped)
{
    const Arguments longer{"film", "film.toml", "--size", "64x64", "-s", "300", "-o", "f.#.exr", "--progress", "none"};
    {
        Program program(folder_, longer);
        ASSERT_TRUE(program.wait_for_message("frame 2: 2 of 8"));
        program.send(SIGKILL);
        EXPECT_EQ(program.wait().code, 1000 + SIGKILL);
    }
    EXPECT_TRUE(exists("f.1.exr"));
    EXPECT_TRUE(exists("f.2.exr"));
    const std::string first = read_bytes(file("f.1.exr"));
    Program program(folder_, longer);
    ASSERT_TRUE(program.wait_for_message("frame 4: 4 of 8"));
    program.send(SIGTERM);
    const Said stopped = program.wait();
    EXPECT_EQ(stopped.code, 75) << stopped.err;
    expect_words(stopped.err, "frames are left; the same command goes on");
    const Said rest = run(longer);
    EXPECT_EQ(rest.code, 0) << rest.err;
    EXPECT_TRUE(read_bytes(file("f.1.exr")) == first);
    for (const char* const number : {"1", "4", "5", "8"})
        EXPECT_TRUE(same_pixels(image("f." + std::string(number) + ".exr"),
                                frame_alone(number, {"--size", "64x64", "-s", "300"})))
            << number;
    EXPECT_EQ(run(longer).out, "");
}

TEST_F(Filmed, ATurntableBeginsWithTheScenesOwnView)
{
    const Arguments turn{"film", "scene.toml", "--turntable", "4", "--size", "24x16", "-s", "4", "-q", "-o"};
    ASSERT_EQ(run(turn + Arguments{"t.##.exr"}).code, 0);
    ASSERT_EQ(render({"-q", "-o", "own.exr"}).code, 0);
    EXPECT_TRUE(same_pixels(image("t.00.exr"), image("own.exr")));
    EXPECT_TRUE(exists("t.03.exr"));
    EXPECT_FALSE(exists("t.04.exr"));
    // The scene's middle is that of its sphere, (0, 1, 0): half a turn from (0, 1, 5) is (0, 1, -5).
    ASSERT_EQ(render({"-q", "-o", "half.exr", "-D", "camera.position=[0,1,-5]", "-o", "half.png"}).code, 0);
    EXPECT_TRUE(same_pixels(image("t.02.exr"), image("half.exr")));
    ASSERT_EQ(render({"-q", "-o", "alone.exr", "--turntable", "4", "--frame", "3"}).code, 0);
    EXPECT_TRUE(same_pixels(image("t.03.exr"), image("alone.exr")));
    EXPECT_EQ(run({"verify", "t.03.exr", "scene.toml"}).code, 0);
    EXPECT_EQ(run(turn + Arguments{"t.##.exr"}).out, "");
    // A bare mesh is lit for its first view, in every frame.
    const Arguments mesh{"quad.obj", "--turntable", "3", "--size", "24x16", "-s", "4", "-q", "-o"};
    ASSERT_EQ(run(Arguments{"film"} + mesh + Arguments{"m.#.exr"}).code, 0);
    ASSERT_EQ(run(Arguments{"render"} + mesh + Arguments{"m.exr", "--frame", "2"}).code, 0);
    EXPECT_TRUE(same_pixels(image("m.2.exr"), image("m.exr")));
    ASSERT_EQ(run({"render", "quad.obj", "--size", "24x16", "-s", "4", "-q", "-o", "own.exr"}).code, 0);
    EXPECT_TRUE(same_pixels(image("m.0.exr"), image("own.exr")));
}

// Frames that were metered one by one would flicker.
TEST_F(Filmed, ATurntableHasTheExposureOfItsFirstView)
{
    // Two walls at a right angle to each other, one white and one nearly black.
    write("walls.mtl", "newmtl white\nKd 0.9 0.9 0.9\nnewmtl black\nKd 0.02 0.02 0.02\n");
    write("walls.obj",
          "mtllib walls.mtl\nv -1 0 1\nv 1 0 1\nv 1 2 1\nv -1 2 1\nv -1 0 -1\nv 1 0 -1\nv 1 2 -1\nv -1 2 -1\n"
          "usemtl white\nf 1 2 3 4\nusemtl black\nf 6 5 8 7\n");
    const Arguments turn{"walls.obj", "--turntable", "2", "--view", "front", "--size", "24x16", "-s", "4", "-q", "-o"};
    ASSERT_EQ(run(Arguments{"film"} + turn + Arguments{"w.#.png"}).code, 0);
    ASSERT_EQ(run(Arguments{"render"} + turn + Arguments{"w.png", "--frame", "1"}).code, 0);
    const auto exposure = [&](const std::string& name) {
        for (const auto& [key, value] : read_png_info(file(name)).metadata)
            if (key == "exposure") return to_string(value);
        return std::string("none");
    };
    EXPECT_EQ(exposure("w.1.png"), exposure("w.0.png"));
    EXPECT_EQ(exposure("w.png"), exposure("w.0.png"));
    EXPECT_EQ(read_png(file("w.1.png")).pixels, read_png(file("w.png")).pixels);
}

// The camera path of the course's program: its bubbles, recorded as key frames.
TEST_F(Filmed, TheCoursesBubblesAreFilmed)
{
    std::string scene = read_bytes(LANCER_SOURCE_DIR "/scenes/seed-a/bubbles.toml");
    write("bubbles.toml", scene +
                              "\n[animation]\nframes = [0, 6]\n[[animation.track]]\nkey = \"camera\"\n"
                              "frames = [0, 3, 6]\nvalues = [{ position = [-6.6, -18.7, 7], target = [0, 0, 4.4] }, "
                              "{ position = [6, -18, 8], target = [0, 0, 4.4] }, "
                              "{ position = [16, -8, 6], target = [0, 0, 3] }]\n");
    const Arguments how{"--legacy", "--size", "32x24", "-q", "--reproducible"};
    const Said said = run(Arguments{"film", "bubbles.toml", "-o", "b.#.ppm", "-o", "b.#.exr"} + how);
    ASSERT_EQ(said.code, 0) << said.err;
    for (const char* const number : {"0", "2", "6"}) {
        ASSERT_EQ(
            run(Arguments{"render", "bubbles.toml", "--frame", number, "-o", "alone.ppm", "-o", "alone.exr"} + how)
                .code,
            0);
        EXPECT_TRUE(read_bytes(file("b." + std::string(number) + ".ppm")) == read_bytes(file("alone.ppm"))) << number;
    }
    EXPECT_FALSE(same_pixels(image("b.0.exr"), image("b.6.exr")));
}

TEST_F(Filmed, AWrittenSceneIsTheFrame)
{
    frame_alone("5", {"--write-scene", "five.toml"});
    EXPECT_EQ(read_bytes(file("five.toml")).find("animation"), std::string::npos);
    ASSERT_EQ(run({"render", "five.toml", "--size", "24x16", "-s", "4", "-q", "-o", "five.exr"}).code, 0);
    EXPECT_TRUE(same_pixels(image("five.exr"), image("alone.exr")));
}

TEST_F(Filmed, WrongUseIsTold)
{
    const auto fails = [&](const Arguments& words, int code, const std::string& message) {
        const Said said = run(words);
        EXPECT_EQ(said.code, code) << message;
        expect_words(said.err, message);
    };
    fails({"film", "scene.toml"}, 2, "the scene has no [animation]; --turntable N turns the camera around it");
    fails({"film", "film.toml", "-o", "f.exr"}, 2, "'f.exr' has no #### for the number; did you mean 'f.####.exr'?");
    fails({"film", "film.toml", "--stats", "s.json"}, 2, "'s.json' has no #### for the number");
    fails({"film", "film.toml", "--frames", "5-9"}, 2, "the film has the frames 1 to 8");
    fails({"film", "film.toml", "--frame", "5"}, 2, "--frames A-B");
    fails({"film", "film.toml", "--turntable", "8"}, 2, "the scene has an [animation] of its own");
    fails({"film", "film.toml", "-o", "f.mp4", "--shard", "1/2"}, 2, "a movie needs all frames");
    fails({"render", "film.toml", "--frame", "9"}, 2, "the frames of the scene are 1 to 8");
    fails({"render", "scene.toml", "--frame", "1"}, 2, "the scene has no [animation]");
    fails({"render", "scene.toml", "--turntable", "8", "--frame", "8"}, 2, "are 0 to 7");
    // A mistake of a late frame is told before the first is drawn.
    write("film.toml", read_bytes(file("film.toml")) +
                           "[[animation.track]]\nkey = \"sphere.0.radius\"\n"
                           "frames = [1, 8]\nvalues = [1, -0.1]\n");
    const Said said = run({"film", "film.toml", "--size", "8x8", "-o", "f.#.exr"});
    EXPECT_EQ(said.code, 65);
    expect_words(said.err, "error: 'radius' in [[sphere]] must be greater than 0");
    expect_words(said.err, ", in frame 8");
    EXPECT_FALSE(exists("f.1.exr"));
}

// A stand-in tells how it was called and keeps what it gets.
TEST_F(Filmed, AMovieIsMadeByFfmpeg)
{
    write("ffmpeg", "#!/bin/sh\necho \"$@\" > called\nfor last; do :; done\ncat > \"${last#file:}\"\n");
    std::filesystem::permissions(file("ffmpeg"), std::filesystem::perms::all);
    const std::string path = "PATH=" + folder_.path() + ":/usr/bin:/bin";
    const Arguments command{"film", "film.toml", "--size", "24x16", "-s", "4", "-q", "--frames", "1-3"};
    const Said said = run(command + Arguments{"-o", "f.#.png", "-o", "film.mp4"}, {path});
    ASSERT_EQ(said.code, 0) << said.err;
    EXPECT_EQ(said.out, "f.1.png\nf.2.png\nf.3.png\nfilm.mp4\n");
    const std::string frames = read_bytes(file("f.1.png")) + read_bytes(file("f.2.png")) + read_bytes(file("f.3.png"));
    EXPECT_TRUE(read_bytes(file("film.mp4")) == frames);
    expect_words(read_bytes(file("called")), "-framerate 12 ");
    // Finished pictures are not drawn again, and still are in it.
    remove("film.mp4");
    EXPECT_EQ(run(command + Arguments{"-o", "f.#.png", "-o", "film.mp4"}, {path}).out, "film.mp4\n");
    EXPECT_TRUE(read_bytes(file("film.mp4")) == frames);
    const Said alone = run(command + Arguments{"-o", "only.mp4", "--reproducible", "--fps", "25"}, {path});
    ASSERT_EQ(alone.code, 0) << alone.err;
    expect_words(read_bytes(file("called")), "-framerate 25 ");
    EXPECT_GT(read_bytes(file("only.mp4")).size(), 3u * 24 * 16);
    write("ffmpeg", "#!/bin/sh\nexit 3\n");
    const Said broken = run(command + Arguments{"-o", "broken.mp4"}, {path});
    EXPECT_EQ(broken.code, 1);
    expect_words(broken.err, "broken.mp4: error: ffmpeg could not write the film");
    EXPECT_FALSE(exists("broken.mp4"));
    const Said none = run(command + Arguments{"-o", "none.mp4"}, {"PATH=/nowhere"});
    EXPECT_EQ(none.code, 1);
    expect_words(none.err, "none.mp4: error: needs ffmpeg, which is not installed");
    for (const std::string& name : folder_.names()) EXPECT_EQ(name.find(".tmp."), std::string::npos) << name;
}

// Whole numbers of [render] stay whole between key frames.
TEST_F(Filmed, EachFrameMayHaveNoiseOfItsOwn)
{
    write("still.toml", small_scene);
    write("seeds.toml", std::string(small_scene) +
                            "[render]\nseed = 0\n[animation]\nframes = [1, 3]\n[[animation.track]]\n"
                            "key = \"render.seed\"\nframes = [1, 3]\nvalues = [11, 13]\n");
    const Said said = run({"film", "seeds.toml", "--size", "24x16", "-s", "2", "-o", "f.#.exr"});
    ASSERT_EQ(said.code, 0) << said.err;
    for (const int frame : {1, 2, 3}) {
        const std::string seed = std::to_string(10 + frame);
        ASSERT_EQ(run({"render", "still.toml", "--size", "24x16", "-s", "2", "--seed", seed, "-q", "-o", "s.exr"}).code,
                  0);
        EXPECT_TRUE(same_pixels(image("s.exr"), image(numbered(frame)))) << "frame " << frame;
    }
}

}  // namespace
}  // namespace lancer
