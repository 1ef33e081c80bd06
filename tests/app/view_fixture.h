// A scene that is opened as lancer view does, without a window: keys, mouse and panel come from the test.
#pragma once

#include <gtest/gtest.h>

#include "app/prepare.h"
#include "app/run_program.h"
#include "app/view/camera_moves.h"
#include "app/view/controller.h"
#include "core/parallel.h"

namespace lancer {

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
        hand().take(picture_);
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

}  // namespace lancer
