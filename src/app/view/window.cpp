#include "app/view/window.h"

#include <atomic>

#include "app/view/window_module.h"
#include "io/module_file.h"

namespace lancer {
namespace {

struct ViewModule {
    decltype(&lancer_view_open) open;
    decltype(&lancer_view_frame) frame;
    decltype(&lancer_view_copy) copy;
    decltype(&lancer_view_wake) wake;
    decltype(&lancer_view_close) close;
};

ViewModule load_view()
{
    void* const library =
        open_module("lancer_view", lancer_view_current_version,
                    "which opens windows, is missing; build the target lancer_view (it needs libglfw3-dev, "
                    "libimgui-dev and libgl-dev, and the option LANCER_WITH_VIEW that is not OFF)");
    ViewModule m = {};
    find_symbol(library, "lancer_view_open", m.open);
    find_symbol(library, "lancer_view_frame", m.frame);
    find_symbol(library, "lancer_view_copy", m.copy);
    find_symbol(library, "lancer_view_wake", m.wake);
    find_symbol(library, "lancer_view_close", m.close);
    return m;
}

const ViewModule& view_module()
{
    static const ViewModule module = load_view();
    return module;
}

std::atomic<decltype(&lancer_view_wake)> wake_of_window{nullptr};

}  // namespace

ViewWindow::ViewWindow(const WindowSetup& setup)
{
    std::string problem;
    window_ = view_module().open(setup, problem);
    if (!window_) throw Error(ErrorKind::failed, "error: no window: " + problem);
    wake_of_window = view_module().wake;
}

ViewWindow::~ViewWindow()
{
    wake_of_window = nullptr;
    view_module().close(window_);
}

void ViewWindow::turn(WindowFrame& frame) { view_module().frame(window_, frame); }
void ViewWindow::copy(const std::string& text) { view_module().copy(window_, text.c_str()); }

void ViewWindow::wake()
{
    if (const auto wake = wake_of_window.load()) wake();
}

}  // namespace lancer
