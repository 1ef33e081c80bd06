// A window of the module lancer_view.
#pragma once

#include <string>

#include "app/view/window_types.h"

namespace lancer {

struct WindowOfModule;

class ViewWindow {
public:
    // Throws Error (failed): without the module, without a display.
    explicit ViewWindow(const WindowSetup& setup);
    ~ViewWindow();
    ViewWindow(const ViewWindow&) = delete;
    ViewWindow& operator=(const ViewWindow&) = delete;

    void turn(WindowFrame& frame);
    void copy(const std::string& text);
    static void wake();  // from any thread; does nothing before the first window

private:
    WindowOfModule* window_;
};

}  // namespace lancer
