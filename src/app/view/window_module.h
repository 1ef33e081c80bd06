// Between lancer and its module lancer_view.so, which alone is linked with GLFW, Dear ImGui and OpenGL: it is opened
// when a window is wanted, so that no other command needs a display library. Both sides are of one build, which the
// version makes sure of.
#pragma once

#include "app/view/window_types.h"

namespace lancer {

struct WindowOfModule;

inline constexpr int32_t lancer_view_current_version = 1;

extern "C" {
int32_t lancer_view_version();
// Null where there is no display or no OpenGL: problem then tells why.
WindowOfModule* lancer_view_open(const WindowSetup& setup, std::string& problem);
// Draws a frame, waits for events until one comes, lancer_view_wake() is called or the time is over, and reports them.
void lancer_view_frame(WindowOfModule* window, WindowFrame& frame);
void lancer_view_copy(WindowOfModule* window, const char* text);  // to the clipboard
void lancer_view_wake();                                          // from any thread
void lancer_view_close(WindowOfModule* window);
}

}  // namespace lancer
