// What the hand does, turned into what the session shows: keys, mouse, panel. It knows no window, so that tests drive
// it by events.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/render/outputs.h"
#include "app/view/edited_scene.h"
#include "app/view/handles.h"
#include "app/view/key_frames.h"
#include "app/view/key_map.h"
#include "app/view/path_lines.h"
#include "app/view/pick.h"
#include "app/view/session.h"
#include "app/view/split.h"
#include "app/view/window_types.h"

namespace lancer {

// What the controller asks of the program around it. Those with a film are called on the session's thread.
struct ControllerHost {
    std::function<void(const std::string&)> print;       // on the standard output
    std::function<void(const std::string&)> say;         // a note to the user
    std::function<void(const std::string&)> copy;        // to the clipboard
    std::function<void(const std::string&)> save_scene;  // the text of a scene file
    // The same over the file of the scene. Returns the name that the old file has now; empty if it cannot be.
    std::function<std::string(const std::string&)> save_over;
    std::function<void(const Film&, const Renderer&, const DisplayCurve&)> write_picture;
};

class Controller {
public:
    Controller(Session& session, EditedScene document, Sight first, DisplayCurve curve, KeyFrames frames,
               ControllerHost host);

    void handle(const InputEvent& event);
    // Moves what moves by itself, `now` in seconds of the clock of events: playing, flying.
    void tick(double now);
    bool is_moving() const { return playing_since_.has_value() || is_flying(); }
    bool wants_close() const { return wants_close_; }

    // As Session::take(): what is to be shown.
    bool take(ShownPicture& picture);
    // Of `picture`, what the window has.
    void draw(const ShownPicture& picture, WindowFrame& frame) const;
    // A widget of draw() that the hand has changed.
    void change(const Widget& widget);

    const Sight& sight() const { return sight_; }
    const EditedScene& document() const { return document_; }
    const DisplayCurve& curve() const { return curve_; }
    const KeyFrames& key_frames() const { return frames_; }
    bool has_new_frames() const { return has_new_frames_; }
    const std::optional<Picked>& picked() const { return picked_; }
    // Of the sight that is shown; see Session::show().
    uint64_t shown_number() const { return number_; }
    std::string scene_text() const;

private:
    enum class Drag { none, orbit, pan, look, handle, line };

    void act(const KeyAction& action);
    void press(const InputEvent& event);
    void release(const InputEvent& event);
    void move(const InputEvent& event);
    void wheel(const InputEvent& event);
    void fly_key(const InputEvent& event);
    bool is_flying() const { return drag_ == Drag::look && flies_ != 0; }
    void drag_handle(double right, double up);
    void move_handle(const Handle& handle, Vec3d to);
    Vec3d place_of(const Handle& handle) const;
    void click(const InputEvent& event);
    void select(const InputEvent& event);
    void still(uint32_t reduction);
    void show_paths();
    void toggle_split();
    bool is_at_line(double x) const;
    void draw_switches(std::vector<Widget>& widgets) const;
    void change_depth(int by);
    void go_to_next_camera();
    void set_camera(const CameraDescription& camera);
    void show();
    void say(const std::string& text);
    std::vector<Handle> handles() const;

    Session& session_;
    EditedScene document_;
    Sight sight_;
    const Sight first_;
    DisplayCurve curve_;
    KeyFrames frames_;
    const ControllerHost host_;

    uint64_t number_ = 1;
    bool has_new_frames_ = false, wants_close_ = false, is_paused_ = false;
    bool shows_help_ = false, shows_handles_ = true, shows_switches_ = false;
    size_t camera_ = 0;  // of the scene's named ones, the next
    std::string message_;

    Drag drag_ = Drag::none;
    bool has_dragged_ = false;
    InputEvent last_, pressed_;
    double last_click_ = -1;
    uint32_t flies_ = 0;  // a bit for each of W, A, S, D that is held
    double ticked_ = 0;
    std::optional<double> playing_since_;
    std::optional<Handle> hovered_, held_;
    std::optional<size_t> light_, sphere_;  // selected
    std::optional<Picked> picked_;
    std::unique_ptr<Split> split_;
    bool is_other_picture_ = false;  // than was taken last: with the split, or without
    // What the session's thread may still be finding when there is no controller any more.
    std::shared_ptr<SharedLines> lines_ = std::make_shared<SharedLines>();
};

}  // namespace lancer
