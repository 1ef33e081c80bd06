// The keys of the window, and what they do. Keys have the numbers of ASCII's capital letters and digits; others are
// listed here.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace lancer {

inline constexpr int key_escape = 256, key_space = ' ', key_f1 = 290;  // to F12: 301
inline constexpr uint8_t mod_shift = 1, mod_control = 2, mod_alt = 4;

enum class Action : uint8_t {
    still_eighth,
    still_half,
    still_full,
    deeper,
    shallower,
    define_frame,   // one of twelve
    restore_frame,  // likewise
    play,
    pause,
    view_front,
    view_side,
    view_top,
    view_own,
    next_camera,
    print_camera,
    write_scene,
    write_over,
    write_picture,
    next_shown,
    brighter,
    darker,
    next_tonemap,
    toggle_handles,
    remove,
    trace_pixel,
    beside,
    help,
    cancel,
    close,
};

struct KeyBinding {
    int key;
    uint8_t mods;
    Action action;
    const char* name;  // of the key
    const char* help;
};
std::span<const KeyBinding> key_bindings();

struct KeyAction {
    Action action;
    uint32_t frame = 0;  // of define_frame and restore_frame: 0 to 11
};
// Nothing for keys that do nothing with these modifiers.
std::optional<KeyAction> action_of(int key, uint8_t mods);

// All keys and what the mouse does, a line each.
std::string key_help();

}  // namespace lancer
