// The module lancer_view: a window of GLFW, drawn by OpenGL, with a panel of Dear ImGui.
#include "app/view/window_module.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl2.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <type_traits>
#include <utility>

#include "app/view/key_map.h"

namespace lancer {
namespace {

constexpr float panel_width = 320, status_height = 26;

std::string problem_of_glfw;

void keep_problem(int, const char* text) { problem_of_glfw = text; }

uint8_t mods_of(int mods)
{
    return static_cast<uint8_t>((mods & GLFW_MOD_SHIFT ? mod_shift : 0) | (mods & GLFW_MOD_CONTROL ? mod_control : 0) |
                                (mods & GLFW_MOD_ALT ? mod_alt : 0));
}

}  // namespace

// Where the picture is drawn: scaled to what the panel leaves, with its own proportions.
struct PicturePlace {
    double x = 0, y = 0, scale = 1;
};

struct WindowOfModule {
    GLFWwindow* window = nullptr;
    GLuint texture = 0;
    int32_t width = 0, height = 0;  // of the texture
    std::vector<InputEvent> events;
    PicturePlace place;
    double mouse_x = 0, mouse_y = 0;  // in the window
    double panel_x = 1e30;            // where the panel begins
    bool is_pressed[3] = {};          // buttons that went down over the picture

    InputEvent event(InputEvent::Kind kind, int key, uint8_t mods) const
    {
        return {.kind = kind,
                .key = key,
                .mods = mods,
                .x = (mouse_x - place.x) / place.scale,
                .y = (mouse_y - place.y) / place.scale,
                .amount = 0,
                .seconds = glfwGetTime()};
    }
    uint8_t held_mods() const
    {
        const auto held = [&](int left, int right) {
            return glfwGetKey(window, left) == GLFW_PRESS || glfwGetKey(window, right) == GLFW_PRESS;
        };
        return static_cast<uint8_t>((held(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT) ? mod_shift : 0) |
                                    (held(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL) ? mod_control : 0) |
                                    (held(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT) ? mod_alt : 0));
    }
};

namespace {

// A pointer or a number, by the version of Dear ImGui.
template <class Id>
Id texture_id(GLuint texture)
{
    if constexpr (std::is_pointer_v<Id>)
        return reinterpret_cast<Id>(static_cast<uintptr_t>(texture));
    else
        return static_cast<Id>(texture);
}

WindowOfModule& of(GLFWwindow* window) { return *static_cast<WindowOfModule*>(glfwGetWindowUserPointer(window)); }

// Dear ImGui knows where the mouse is only when a frame begins; a click may come before.
bool is_of_panel(const WindowOfModule& w) { return ImGui::GetIO().WantCaptureMouse || w.mouse_x >= w.panel_x; }

void on_key(GLFWwindow* window, int key, int, int action, int mods)
{
    if (ImGui::GetIO().WantTextInput) return;
    // Keys of the row of functions repeat what they do, not how long they are held.
    if (action == GLFW_REPEAT) return;
    WindowOfModule& w = of(window);
    w.events.push_back(w.event(action == GLFW_PRESS ? InputEvent::Kind::key_down : InputEvent::Kind::key_up,
                               key == GLFW_KEY_ESCAPE ? key_escape : key, mods_of(mods)));
}

void on_button(GLFWwindow* window, int button, int action, int mods)
{
    WindowOfModule& w = of(window);
    if (button < 0 || button > 2) return;
    const bool is_down = action == GLFW_PRESS;
    if (is_down && is_of_panel(w)) return;
    if (!is_down && !w.is_pressed[button]) return;
    w.is_pressed[button] = is_down;
    w.events.push_back(
        w.event(is_down ? InputEvent::Kind::button_down : InputEvent::Kind::button_up, button, mods_of(mods)));
}

void on_move(GLFWwindow* window, double x, double y)
{
    WindowOfModule& w = of(window);
    w.mouse_x = x, w.mouse_y = y;
    const bool is_dragging = std::any_of(std::begin(w.is_pressed), std::end(w.is_pressed), [](bool b) { return b; });
    if (!is_dragging && ImGui::GetIO().WantCaptureMouse) return;
    w.events.push_back(w.event(InputEvent::Kind::move, 0, w.held_mods()));
}

void on_wheel(GLFWwindow* window, double, double amount)
{
    WindowOfModule& w = of(window);
    if (is_of_panel(w)) return;
    InputEvent e = w.event(InputEvent::Kind::wheel, 0, w.held_mods());
    e.amount = amount;
    w.events.push_back(e);
}

void draw_widget(Widget& w)
{
    float numbers[3] = {static_cast<float>(w.value[0]), static_cast<float>(w.value[1]), static_cast<float>(w.value[2])};
    const auto least = static_cast<float>(std::max(w.least, -1e30)), most = static_cast<float>(std::min(w.most, 1e30));
    switch (w.kind) {
        case Widget::Kind::heading:
            ImGui::Separator();
            ImGui::TextUnformatted(w.label.c_str());
            break;
        case Widget::Kind::text:
            ImGui::TextWrapped("%s", w.label.c_str());
            break;
        case Widget::Kind::number:
            w.is_changed =
                ImGui::DragScalarN(w.label.c_str(), ImGuiDataType_Double, w.value.data(), static_cast<int>(w.count),
                                   static_cast<float>(w.step), &w.least, &w.most, "%.5g");
            break;
        case Widget::Kind::color:
            w.is_changed = ImGui::DragFloat3(w.label.c_str(), numbers, static_cast<float>(w.step), least, most, "%.4g");
            ImGui::SameLine();
            if (ImGui::ColorButton(("##" + w.label).c_str(), {numbers[0], numbers[1], numbers[2], 1}))
                w.is_changed = false;
            if (w.is_changed) w.value = {numbers[0], numbers[1], numbers[2]};
            break;
        case Widget::Kind::choice: {
            int chosen = static_cast<int>(w.value[0]);
            std::string items;
            for (const std::string& c : w.choices) items += c + '\0';
            w.is_changed = ImGui::Combo(w.label.c_str(), &chosen, items.c_str());
            w.value[0] = chosen;
            break;
        }
        case Widget::Kind::toggle: {
            bool is_on = w.value[0] != 0;
            w.is_changed = ImGui::Checkbox(w.label.c_str(), &is_on);
            w.value[0] = is_on ? 1 : 0;
            break;
        }
        case Widget::Kind::button:
            w.is_changed = ImGui::Button(w.label.c_str());
            break;
    }
}

void draw_marks(const WindowOfModule& w, const std::vector<Mark>& marks)
{
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const auto at = [&](double x, double y) {
        return ImVec2(static_cast<float>(w.place.x + x * w.place.scale),
                      static_cast<float>(w.place.y + y * w.place.scale));
    };
    for (const Mark& m : marks) {
        const auto radius = static_cast<float>(m.x1 * w.place.scale);
        if (m.kind == Mark::Kind::line) list.AddLine(at(m.x0, m.y0), at(m.x1, m.y1), m.color, 1.5f);
        if (m.kind == Mark::Kind::circle) list.AddCircle(at(m.x0, m.y0), radius, m.color, 32, 1.5f);
        if (m.kind == Mark::Kind::disc) list.AddCircleFilled(at(m.x0, m.y0), radius, m.color, 32);
        if (m.kind == Mark::Kind::text) list.AddText(at(m.x0, m.y0), m.color, m.text.c_str());
    }
}

void upload(WindowOfModule& w, const WindowFrame& f)
{
    if (!f.rgb || f.first_row >= f.end_row) return;
    glBindTexture(GL_TEXTURE_2D, w.texture);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const bool is_other = w.width != f.width || w.height != f.height;
    w.width = f.width, w.height = f.height;
    if (is_other)
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, f.width, f.height, 0, GL_RGB, GL_UNSIGNED_BYTE, f.rgb);
    else
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, f.first_row, f.width, f.end_row - f.first_row, GL_RGB, GL_UNSIGNED_BYTE,
                        f.rgb + size_t{3} * static_cast<size_t>(f.width) * static_cast<size_t>(f.first_row));
}

void draw_panel(WindowFrame& frame, int width, int height)
{
    ImGui::SetNextWindowPos({static_cast<float>(width) - panel_width, 0});
    ImGui::SetNextWindowSize({panel_width, static_cast<float>(height)});
    ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove);
    ImGui::PushItemWidth(0.6f * panel_width);
    for (Widget& widget : frame.widgets) draw_widget(widget);
    ImGui::PopItemWidth();
    ImGui::End();
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddText({6, static_cast<float>(height) - status_height + 6}, 0xffd0d0d0, frame.status.c_str());
    if (frame.overlay.empty()) return;
    const ImVec2 size = ImGui::CalcTextSize(frame.overlay.c_str());
    list.AddRectFilled({8, 8}, {24 + size.x, 24 + size.y}, 0xc0000000);
    list.AddText({16, 16}, 0xffffffff, frame.overlay.c_str());
}

void draw_frame(WindowOfModule& w, WindowFrame& frame)
{
    int width = 0, height = 0, pixels_across = 0, pixels_down = 0;
    glfwGetWindowSize(w.window, &width, &height);
    glfwGetFramebufferSize(w.window, &pixels_across, &pixels_down);
    const double room_x = std::max(1.0, width - double{panel_width}),
                 room_y = std::max(1.0, height - double{status_height});
    w.place.scale = std::min(room_x / frame.picture_width, room_y / frame.picture_height);
    w.place.x = std::floor((room_x - frame.picture_width * w.place.scale) / 2);
    w.place.y = std::floor((room_y - frame.picture_height * w.place.scale) / 2);
    w.panel_x = width - double{panel_width};
    upload(w, frame);

    ImGui_ImplOpenGL2_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    const auto at = [&](double x, double y) {
        return ImVec2(static_cast<float>(w.place.x + x * w.place.scale),
                      static_cast<float>(w.place.y + y * w.place.scale));
    };
    if (w.width > 0)
        ImGui::GetBackgroundDrawList()->AddImage(texture_id<ImTextureID>(w.texture), at(0, 0),
                                                 at(frame.picture_width, frame.picture_height));
    draw_marks(w, frame.marks);
    draw_panel(frame, width, height);
    ImGui::Render();
    glViewport(0, 0, pixels_across, pixels_down);
    glClearColor(0.1f, 0.1f, 0.1f, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL2_RenderDrawData(ImGui::GetDrawData());
    glfwSwapBuffers(w.window);
    frame.drawn_seconds = glfwGetTime();
}

}  // namespace

int32_t lancer_view_version() { return lancer_view_current_version; }

WindowOfModule* lancer_view_open(const WindowSetup& setup, std::string& problem)
{
    glfwSetErrorCallback(keep_problem);
    problem_of_glfw.clear();
    const auto fail = [&](const std::string& what) {
        problem = what + (problem_of_glfw.empty() ? "" : " (" + problem_of_glfw + ")");
        return nullptr;
    };
    if (!glfwInit()) return fail("there is no display");
    const int width = setup.picture_width + static_cast<int>(panel_width);
    const int height = setup.picture_height + static_cast<int>(status_height);
    auto w = std::make_unique<WindowOfModule>();
    w->window = glfwCreateWindow(width, std::max(height, 480), setup.title.c_str(), nullptr, nullptr);
    if (!w->window) return fail("the display has no OpenGL");
    glfwMakeContextCurrent(w->window);
    // A frame is drawn when there is something new; waiting for the screen would only delay it.
    glfwSwapInterval(0);
    glfwSetWindowUserPointer(w->window, w.get());
    glfwSetKeyCallback(w->window, on_key);
    glfwSetMouseButtonCallback(w->window, on_button);
    glfwSetCursorPosCallback(w->window, on_move);
    glfwSetScrollCallback(w->window, on_wheel);
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetStyle().WindowRounding = 0;
    ImGui_ImplGlfw_InitForOpenGL(w->window, true);  // it calls the callbacks above, too
    ImGui_ImplOpenGL2_Init();
    glGenTextures(1, &w->texture);
    glBindTexture(GL_TEXTURE_2D, w->texture);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
    return w.release();
}

void lancer_view_frame(WindowOfModule* window, WindowFrame& frame)
{
    if (frame.is_drawn) draw_frame(*window, frame);
    glfwWaitEventsTimeout(frame.wait_seconds);
    frame.seconds = glfwGetTime();
    frame.events = std::exchange(window->events, {});
    frame.should_close = glfwWindowShouldClose(window->window) != 0;
}

void lancer_view_copy(WindowOfModule* window, const char* text) { glfwSetClipboardString(window->window, text); }

void lancer_view_wake() { glfwPostEmptyEvent(); }

void lancer_view_close(WindowOfModule* window)
{
    ImGui_ImplOpenGL2_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(window->window);
    glfwTerminate();
    delete window;
}

}  // namespace lancer
