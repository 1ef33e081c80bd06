// lancer view as it is used: on a display, with real keys and a real mouse. Skipped where there is no Xvfb or xdotool,
// or where the module was not built.
#include <gtest/gtest.h>

#include <thread>

#include "app/run_program.h"
#include "app/view/camera_moves.h"
#include "app/view/handles.h"
#include "app/x_server.h"
#include "io/scene/scene_file.h"

namespace lancer {
namespace {

// So high that the window shows each pixel of the picture as one of its own, from its upper left corner on.
constexpr uint32_t across = 320, down = 454;

bool has_view_module()
{
    return std::filesystem::exists(std::filesystem::path(LANCER_PROGRAM).parent_path() / "lancer_view.so");
}

class WindowTest : public AppTest {
protected:
    void SetUp() override
    {
        if (!has_view_module()) GTEST_SKIP() << "lancer_view.so was not built";
        if (const std::string missing = XServer::missing(); !missing.empty()) GTEST_SKIP() << missing;
        server_ = std::make_unique<XServer>();
        if (!server_->is_there()) GTEST_SKIP() << "Xvfb does not start";
    }
    // Starts it and waits for its window to listen.
    void start(const std::string& scene, const std::vector<std::string>& more = {})
    {
        Arguments all{"view", scene, "--size", "320x454", "-s", "4", "-o", "view.exr", "--write-scene", "written.toml"};
        program_ =
            std::make_unique<Program>(folder_, all + more, Arguments{server_->variable(), "LIBGL_ALWAYS_SOFTWARE=1"});
        ASSERT_TRUE(program_->wait_for([&] { return server_->tool("search --onlyvisible --name '^lancer '"); }))
            << program_->err();
        ASSERT_TRUE(tool("search --onlyvisible --name '^lancer ' windowmove 0 0 windowfocus --sync"));
        // The first key that does something tells that it is heard.
        ASSERT_TRUE(program_->wait_for([&] {
            key("n");
            return program_->err().find("[camera.NAME]") != std::string::npos;
        }));
    }
    bool tool(const std::string& arguments) const { return server_->tool(arguments); }
    void key(const std::string& name) const { tool("key " + name); }
    void drag(int button, double x0, double y0, double x1, double y1) const
    {
        const auto move = [](double x, double y) {
            return " mousemove " + std::to_string(std::lround(x)) + " " + std::to_string(std::lround(y)) +
                   " sleep 0.05";
        };
        const std::string b = std::to_string(button);
        EXPECT_TRUE(tool(move(x0, y0) + " mousedown " + b + move((x0 + x1) / 2, (y0 + y1) / 2) + move(x1, y1) +
                         " mouseup " + b + " sleep 0.05"));
    }
    // Presses a key that writes a file, and waits until it is there.
    void write_by(const std::string& name, const std::string& written)
    {
        std::filesystem::remove(file(written));
        key(name);
        ASSERT_TRUE(program_->wait_for([&] { return exists(written); })) << name << '\n' << program_->err();
    }
    SceneDescription saved()
    {
        write_by("ctrl+s", "written.toml");
        Diagnostics none;
        return load_scene_file(file("written.toml"), {}, none);
    }
    void expect_rendered(const std::string& name, const std::string& size)
    {
        saved();
        // What O writes is complete in the end.
        do write_by(name, "view.exr");
        while (metadata("view.exr", "spp_done") != "4" && !program_->has_ended());
        const Said said = run({"render", "written.toml", "-q", "--size", size, "-o", "render.exr"});
        ASSERT_EQ(said.code, 0) << said.err;
        EXPECT_TRUE(same_pixels(image("view.exr"), image("render.exr"))) << name;
    }
    void close()
    {
        const auto begin = std::chrono::steady_clock::now();
        key("ctrl+q");
        const Said said = program_->wait();
        EXPECT_EQ(said.code, 0) << said.err;
        // 0.2 s on an idle machine.
        EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 10);
    }

    std::unique_ptr<XServer> server_;
    std::unique_ptr<Program> program_;
};

const char* const lamp_scene = R"(version = 1
[camera]
position = [0, 1, 9]
target = [0, 1, 0]
[[plane]]
normal = [0, 1, 0]
point = [0, 0, 0]
[[sphere]]
center = [0, 1, 0]
radius = 1
[[light]]
type = "point"
position = [1, 3, 2]
intensity = [20, 18, 15]
[[light]]
type = "environment"
radiance = [0.2, 0.3, 0.4]
)";

TEST_F(WindowTest, KeysAndMouseDoWhatTheSceneFileSays)
{
    write("lamp.toml", lamp_scene);
    start("lamp.toml");
    const SceneDescription before = saved();
    const auto handles = handles_of(before, *before.camera, {across, down});
    ASSERT_EQ(handles.size(), 1u);
    drag(1, handles[0].x, handles[0].y, handles[0].x - 60, handles[0].y + 30);
    const SceneDescription lit = saved();
    EXPECT_LT(lit.lights[0].position.x, before.lights[0].position.x - 0.5);
    EXPECT_LT(lit.lights[0].position.y, before.lights[0].position.y - 0.2);
    EXPECT_TRUE(is_same_view(*lit.camera, *before.camera));
    drag(1, 60, 400, 100, 380);
    const SceneDescription orbited = saved();
    EXPECT_FALSE(is_same_view(*orbited.camera, *before.camera));
    EXPECT_EQ(orbited.lights[0].position, lit.lights[0].position);
    key("d");
    ASSERT_TRUE(program_->wait_for_message("Max depth is 20"));
    key("shift+d");
    ASSERT_TRUE(program_->wait_for_message("Max depth is 19"));
    expect_rendered("r", "40x56");
    expect_rendered("shift+r", "160x227");
    expect_rendered("ctrl+r", "320x454");
    key("alt+F1");
    ASSERT_TRUE(program_->wait_for_message("key frame F1 is defined"));
    drag(1, 60, 400, 20, 390);
    EXPECT_FALSE(is_same_view(*saved().camera, *orbited.camera));
    key("F1");
    EXPECT_TRUE(is_same_view(*saved().camera, *orbited.camera));
    expect_rendered("o", "320x454");
    close();
    expect_words(read_bytes(file("lamp.path.toml")), "[camera.F1]");
}

TEST_F(WindowTest, ThreeScenes)
{
    write("lamp.toml", lamp_scene);
    const std::string scenes = LANCER_SOURCE_DIR "/scenes/";
    for (const std::string& scene : {scenes + "spheres.toml", scenes + "cornell.toml", file("quad.obj")}) {
        start(scene);
        drag(1, 60, 400, 90, 390);
        write_by("ctrl+s", "written.toml");
        write_by("ctrl+r", "view.exr");
        Arguments render{"render", "written.toml", "-q", "-o", "render.exr"};
        if (scene.starts_with(scenes)) render = render + Arguments{"--asset-root", scenes};
        const Said said = run(render);
        ASSERT_EQ(said.code, 0) << said.err;
        EXPECT_TRUE(same_pixels(image("view.exr"), image("render.exr"))) << scene;
        close();
    }
}

TEST_F(AppTest, TheProgramIsLinkedWithNoDisplayLibrary)
{
    const std::string program = read_bytes(LANCER_PROGRAM);
    for (const char* library : {"libglfw.so", "libGL.so", "libX11.so"})
        EXPECT_EQ(program.find(library), program.npos) << library;
}

TEST_F(AppTest, ViewWithoutADisplayFailsClearly)
{
    if (!has_view_module()) GTEST_SKIP() << "lancer_view.so was not built";
    const Said said = run({"view", "scene.toml"}, {"DISPLAY=:99999", "WAYLAND_DISPLAY="});
    EXPECT_EQ(said.code, 1);
    expect_words(said.err, "error: no window: there is no display");
}

TEST_F(AppTest, ViewWithoutItsModuleSaysWhatIsMissing)
{
    std::filesystem::copy_file(LANCER_PROGRAM, file("lancer"));
    const std::string command = "cd " + folder_.path() + " && ./lancer view scene.toml 2> said; echo $? > code";
    ASSERT_EQ(std::system(command.c_str()), 0);
    EXPECT_EQ(read_bytes(file("code")), "1\n");
    for (const char* words : {"lancer_view", "libglfw3-dev", "libimgui-dev", "LANCER_WITH_VIEW"})
        expect_words(read_bytes(file("said")), words);
}

}  // namespace
}  // namespace lancer
