#include "app/view/key_map.h"

#include <algorithm>
#include <array>

namespace lancer {
namespace {

using enum Action;
constexpr std::array bindings{
    KeyBinding{'R', 0, still_eighth, "R", "render 1/8 of the size into the file of -o"},
    KeyBinding{'R', mod_shift, still_half, "Shift+R", "render 1/2 of the size into it"},
    KeyBinding{'R', mod_control, still_full, "Ctrl+R", "render the full size into it"},
    KeyBinding{'D', 0, deeper, "D", "maximum depth + 1"},
    KeyBinding{'D', mod_shift, shallower, "Shift+D", "maximum depth - 1"},
    KeyBinding{key_f1, mod_alt, define_frame, "Alt+F1..F12", "define a key frame"},
    KeyBinding{key_f1, 0, restore_frame, "F1..F12", "go to a key frame"},
    KeyBinding{'P', 0, play, "P", "play the key frames, or stop"},
    KeyBinding{key_space, 0, pause, "Space", "pause, or go on"},
    KeyBinding{'1', 0, view_front, "1", "view from the front"},
    KeyBinding{'3', 0, view_side, "3", "view from the side"},
    KeyBinding{'7', 0, view_top, "7", "view from above"},
    KeyBinding{'0', 0, view_own, "0", "the camera that the scene was opened with"},
    KeyBinding{'N', 0, next_camera, "N", "next camera of the scene"},
    KeyBinding{'C', 0, print_camera, "C", "print and copy the table [camera]"},
    KeyBinding{'S', mod_control, write_scene, "Ctrl+S", "write the scene as it is now"},
    KeyBinding{'S', mod_control | mod_shift, write_over, "Ctrl+Shift+S",
               "write it over its file, which is kept beside it"},
    KeyBinding{'O', 0, write_picture, "O", "write the picture as it is into the file of -o"},
    KeyBinding{'V', 0, next_shown, "V", "light, noise, samples, albedo, normals, depth"},
    KeyBinding{'E', 0, brighter, "E", "exposure + 1/3 stop"},
    KeyBinding{'E', mod_shift, darker, "Shift+E", "exposure - 1/3 stop"},
    KeyBinding{'T', 0, next_tonemap, "T", "next tone map"},
    KeyBinding{'L', 0, toggle_handles, "L", "handles of lights on or off"},
    KeyBinding{'X', 0, remove, "X", "turn the selected light off"},
    KeyBinding{'I', 0, trace_pixel, "I", "the paths of the pixel under the mouse, or no more"},
    KeyBinding{'B', 0, beside, "B", "keep the settings on the left beside other ones, or no more"},
    KeyBinding{'H', 0, help, "H", "this list on or off"},
    KeyBinding{key_escape, 0, cancel, "Escape", "give up what is rendered into a file"},
    KeyBinding{'Q', mod_control, close, "Ctrl+Q", "close"},
};

constexpr const char* mouse_help =
    "left drag: orbit    Shift or middle drag: pan    wheel: dolly\n"
    "right drag: look around, with W A S D fly\n"
    "double click: centre    click: select    Ctrl+click: focus\n"
    "on a light's handle: drag in the view plane, wheel along the view\n";

}  // namespace

std::span<const KeyBinding> key_bindings() { return bindings; }

std::optional<KeyAction> action_of(int key, uint8_t mods)
{
    uint32_t frame = 0;
    if (key > key_f1 && key < key_f1 + 12) frame = static_cast<uint32_t>(key - key_f1), key = key_f1;
    for (const KeyBinding& b : bindings)
        if (b.key == key && b.mods == mods) return KeyAction{b.action, frame};
    return {};
}

std::string key_help()
{
    std::string text;
    for (const KeyBinding& b : bindings) {
        const std::string name = b.name;
        text += name + std::string(name.size() < 12 ? 12 - name.size() : 0, ' ') + b.help + "\n";
    }
    return text + mouse_help;
}

}  // namespace lancer
