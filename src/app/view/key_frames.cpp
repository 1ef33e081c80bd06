#include "app/view/key_frames.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/view/camera_moves.h"
#include "io/toml_file.h"
#include "io/toml_reader.h"

namespace lancer {
namespace {

template <class T>
T spline(const std::array<T, 4>& p, double t)
{
    return (p[1] * 2.0 + (p[2] - p[0]) * t + (p[0] * 2.0 - p[1] * 5.0 + p[2] * 4.0 - p[3]) * (t * t) +
            (p[1] * 3.0 - p[0] - p[2] * 3.0 + p[3]) * (t * t * t)) *
           0.5;
}

std::string name_of_frame(uint32_t frame) { return "F" + std::to_string(frame + 1); }

}  // namespace

uint32_t KeyFrames::defined() const
{
    return static_cast<uint32_t>(
        std::count_if(frames_.begin(), frames_.end(), [](const auto& f) { return f.has_value(); }));
}

CameraDescription KeyFrames::along(double time) const
{
    std::vector<CameraDescription> path;
    for (const auto& frame : frames_)
        if (frame) path.push_back(*frame);
    const auto last = static_cast<double>(path.size() - 1);
    time = std::clamp(time, 0.0, last);
    const double whole = std::min(std::floor(time), std::max(0.0, last - 1)), t = time - whole;
    // A frame has its very bits.
    if (t == 0 || path.size() == 1) return path[static_cast<size_t>(time)];
    if (t == 1) return path[static_cast<size_t>(whole) + 1];
    const auto at = [&](auto member) {
        using T = std::remove_cvref_t<decltype(path[0].*member)>;
        std::array<T, 4> p{};
        for (int i = 0; i < 4; ++i)
            p[static_cast<size_t>(i)] = path[static_cast<size_t>(std::clamp(whole + i - 1, 0.0, last))].*member;
        return spline(p, t);
    };
    CameraDescription camera = path[static_cast<size_t>(whole)];
    const auto& next = path[static_cast<size_t>(whole) + 1];
    camera.position = at(&CameraDescription::position);
    camera.target = at(&CameraDescription::target);
    camera.up = at(&CameraDescription::up);
    camera.fov_deg = std::clamp(at(&CameraDescription::fov_deg), 0.1, 179.0);
    camera.aperture = std::max(0.0, at(&CameraDescription::aperture));
    if (camera.focus && next.focus) camera.focus = *camera.focus + (*next.focus - *camera.focus) * t;
    return camera;
}

std::string KeyFrames::text() const
{
    std::string text;
    for (uint32_t i = 0; i < count; ++i)
        if (frames_[i]) text += (text.empty() ? "" : "\n") + camera_table(*frames_[i], name_of_frame(i));
    return text;
}

void KeyFrames::read(const std::string& text, const std::string& path)
{
    Diagnostics diagnostics;
    const std::optional<TomlValue> root = parse_toml(text, path, diagnostics);
    diagnostics.throw_if_errors();
    TomlProblems problems({path});
    const std::optional<TomlTable> cameras = TomlTable(*root, "", problems).table("camera");
    for (uint32_t i = 0; cameras && i < count; ++i) {
        const std::optional<TomlTable> table = cameras->inner_table(name_of_frame(i));
        if (!table) continue;
        CameraDescription c;
        c.name = name_of_frame(i);
        if (const auto v = table->vector("position")) c.position = *v;
        if (const auto v = table->vector("target")) c.target = *v;
        if (const auto v = table->vector("up")) c.up = *v;
        if (const auto x = table->number("fov", half_turn)) c.fov_deg = *x;
        if (const auto t = table->text("type"); t && *t == "thin_lens") c.type = CameraType::thin_lens;
        if (const auto x = table->number("aperture", zero_or_more)) c.aperture = *x;
        c.focus = table->number("focus", above_zero);
        frames_[i] = c;
    }
    problems.report(diagnostics);
    diagnostics.throw_if_errors();
}

}  // namespace lancer
