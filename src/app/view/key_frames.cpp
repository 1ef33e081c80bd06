#include "app/view/key_frames.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "app/view/camera_moves.h"
#include "core/key_curve.h"
#include "io/toml_file.h"
#include "io/toml_reader.h"

namespace lancer {
namespace {

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
    std::vector<double> times(path.size());
    std::iota(times.begin(), times.end(), 0.0);
    const KeyPlace place = place_among(times, time);
    CameraDescription camera = path[place.at];
    if (place.u == 0) return camera;  // a frame has its very bits
    const auto number = [&](const auto& of) {
        std::vector<double> values;
        for (const CameraDescription& frame : path) values.push_back(of(frame));
        return smooth_at(times, values, place);
    };
    const auto vector = [&](Vec3d CameraDescription::*member) {
        const auto part = [&](double Vec3d::*axis) {
            return number([&](const CameraDescription& frame) { return frame.*member.*axis; });
        };
        return Vec3d{part(&Vec3d::x), part(&Vec3d::y), part(&Vec3d::z)};
    };
    camera.position = vector(&CameraDescription::position);
    camera.target = vector(&CameraDescription::target);
    camera.up = vector(&CameraDescription::up);
    camera.fov_deg = std::clamp(number([](const CameraDescription& frame) { return frame.fov_deg; }), 0.1, 179.0);
    camera.aperture = std::max(0.0, number([](const CameraDescription& frame) { return frame.aperture; }));
    if (const auto& next = path[place.at + 1].focus; camera.focus && next)
        *camera.focus += (*next - *camera.focus) * place.u;
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
