// What the program and the module of the window tell each other: the picture with what is drawn over it, the panel
// beside it, and what the hand does. Pixels are those of the full picture, x to the right, y down.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace lancer {

struct InputEvent {
    enum class Kind : uint8_t { key_down, key_up, button_down, button_up, move, wheel } kind = Kind::move;
    int key = 0;          // of keys: see app/view/key_map.h; of buttons: 0 left, 1 right, 2 middle
    uint8_t mods = 0;     // mod_shift and so on
    double x = 0, y = 0;  // where the mouse is
    double amount = 0;    // wheel: notches, away from the hand
    double seconds = 0;   // when it came, by the clock of the window
};

// A line, circle or text over the picture. Colours are 0xAABBGGRR.
struct Mark {
    enum class Kind : uint8_t { line, circle, disc, text } kind = Kind::line;
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // of circles x1 is the radius
    uint32_t color = 0xffffffff;
    std::string text{};
};

struct Widget {
    enum class Kind : uint8_t { heading, text, number, color, choice, toggle, button } kind = Kind::text;
    int id = 0;                     // for whoever made it
    std::string label;              // unique in the panel
    std::array<double, 3> value{};  // number: `count` of them; choice: its index; toggle: 0 or 1
    uint32_t count = 1;
    double step = 0.01, least = -1e300, most = 1e300;
    std::vector<std::string> choices{};
    bool is_changed = false;  // by the hand, in the frame that ends
};

// One turn of the window.
struct WindowFrame {
    // The picture in bytes, RGB; rows [first_row, end_row) are new. The size may change from frame to frame.
    const uint8_t* rgb = nullptr;
    int32_t width = 0, height = 0, first_row = 0, end_row = 0;
    int32_t picture_width = 0, picture_height = 0;  // that marks and events refer to
    std::vector<Mark> marks;
    std::vector<Widget> widgets;
    std::string status, overlay;  // one line below the picture; lines over it, or empty
    double wait_seconds = 0;      // for events, at most
    bool is_drawn = true;         // else it only waits

    std::vector<InputEvent> events;  // what came
    bool should_close = false;
    double drawn_seconds = 0;  // when the frame was on the screen, by the clock of events
    double seconds = 0;        // now, likewise
};

struct WindowSetup {
    std::string title;
    int32_t picture_width = 0, picture_height = 0;
};

}  // namespace lancer
