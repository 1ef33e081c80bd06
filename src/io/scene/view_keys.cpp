#include "io/scene/view_keys.h"

#include <algorithm>

#include "io/scene/camera_tables.h"

namespace lancer {
namespace {

using CameraEntries = TomlValue::Table;

// Adds what is not there yet and moves with a view.
void inherit(CameraEntries& table, const CameraEntries& from, std::span<const std::string_view> keys)
{
    for (const std::string_view key : keys)
        if (const TomlValue* value = value_at(from, key); value && !value_at(table, key))
            table.push_back({.key = std::string(key), .value = *value});
}

// A [camera.NAME], with what it takes from [camera]. Null and a problem if there is none.
std::optional<TomlValue> named_camera(const TomlValue& name, const CameraEntries& cameras, TomlProblems& problems)
{
    const auto& text = std::get<std::string>(name.data);
    const TomlValue* found = value_at(cameras, text);
    if (found && std::holds_alternative<CameraEntries>(found->data)) {
        TomlValue whole{.line = name.line, .column = name.column, .data = CameraEntries{}, .source = name.source};
        auto& entries = std::get<CameraEntries>(whole.data);
        inherit(entries, std::get<CameraEntries>(found->data), view_key_names);
        inherit(entries, cameras, view_key_names);
        return whole;
    }
    NameList known;
    for (const TomlEntry& e : cameras)
        if (std::holds_alternative<CameraEntries>(e.value.data)) known.push_back(e.key);
    problems.add(problems.where(name),
                 "unknown camera " + in_quotes(text) +
                     (known.empty() ? "; the file has no [camera.NAME]" : suggestion(text, known)));
    return {};
}

TomlValue to_toml(Vec3d v, const TomlValue& origin)
{
    return {.line = origin.line,
            .column = origin.column,
            .data = TomlValue::Array{{.data = v.x}, {.data = v.y}, {.data = v.z}},
            .source = origin.source};
}

}  // namespace

std::optional<ViewKeys::Key> ViewKeys::read_key(const TomlTable& table)
{
    constexpr double least_sine = 1e-6;  // as of [camera]
    table.allow({view_key_names.begin(), view_key_names.end()});
    if (!table.require("position") || !table.require("target")) return {};
    const auto position = table.vector("position"), target = table.vector("target");
    const std::optional<Vec3d> said_up = read_up(table);
    Key key;
    key.fov = table.number("fov", any_number);
    key.focus = table.number("focus", any_number);
    key.aperture = table.number("aperture", any_number);
    if (!position || !target || (table.has("up") && !said_up)) return {};
    key.position = *position, key.target = *target, key.up = said_up.value_or(Vec3d{0, 1, 0});
    const Vec3d forward = normalize(key.target - key.position), right = cross(forward, normalize(key.up));
    if (!is_finite(forward)) {
        table.error(table.where(), "'position' and 'target' in " + table.label() + " must be different points");
        return {};
    }
    if (!(length(right) > least_sine)) {
        table.error(table.where(),
                    "'up' in " + table.label() + " must not be parallel to the view, from 'position' to 'target'");
        return {};
    }
    const Vec3d x = normalize(right);
    key.turn = rotation_to(x, cross(x, forward), -forward);
    return key;
}

std::optional<ViewKeys> ViewKeys::read(const TomlValue::Array& values, const TomlValue* cameras, TomlProblems& problems)
{
    const auto* in_file = cameras ? std::get_if<CameraEntries>(&cameras->data) : nullptr;
    const CameraEntries& known = in_file ? *in_file : CameraEntries{};
    ViewKeys all;
    for (const TomlValue& value : values) {
        std::string label = "the values of 'camera'";
        std::optional<TomlValue> camera = value;
        if (const auto* name = std::get_if<std::string>(&value.data)) {
            label = "[camera." + on_one_line(*name) + "]";
            camera = named_camera(value, known, problems);
        } else if (auto* table = std::get_if<CameraEntries>(&camera->data)) {
            inherit(*table, known, std::array<std::string_view, 2>{"up", "fov"});
        } else {
            problems.add(problems.where(value),
                         "a camera must be the name of a [camera.NAME] or a table { position = ..., target = ... }");
            camera.reset();
        }
        if (!camera) return {};
        std::optional<Key> key = read_key(TomlTable(*camera, label, problems));
        if (!key) return {};
        key->origin = {.line = value.line, .column = value.column, .data = {}, .source = value.source};
        all.keys_.push_back(std::move(*key));
    }
    // What some cameras of a track say the others have by default.
    const auto fill = [&](std::optional<double> Key::*field, const auto& usual) {
        if (std::any_of(all.keys_.begin(), all.keys_.end(), [&](const Key& key) { return (key.*field).has_value(); }))
            for (Key& key : all.keys_) key.*field = (key.*field).value_or(usual(key));
    };
    fill(&Key::fov, [](const Key&) { return CameraDescription{}.fov_deg; });
    fill(&Key::focus, [](const Key& key) { return length(key.target - key.position); });
    fill(&Key::aperture, [](const Key&) { return CameraDescription{}.aperture; });
    return all;
}

TomlValue::Table ViewKeys::at(std::span<const double> times, KeyPlace place, bool is_smooth) const
{
    const Key& key = keys_[place.at];
    std::vector<double> column(keys_.size());
    const auto curve = [&](const auto& number_of, bool smooth) {
        std::transform(keys_.begin(), keys_.end(), column.begin(), number_of);
        return smooth ? smooth_at(times, column, place) : linear_at(column, place);
    };
    Vec3d position = key.position, target = key.target, up = key.up;
    if (place.u > 0) {
        position = {curve([](const Key& k) { return k.position.x; }, is_smooth),
                    curve([](const Key& k) { return k.position.y; }, is_smooth),
                    curve([](const Key& k) { return k.position.z; }, is_smooth)};
        const Quaternion turn = slerp(key.turn, keys_[place.at + 1].turn, place.u);
        const double distance = curve([](const Key& k) { return length(k.target - k.position); }, false);
        target = position - rotate(turn, {0, 0, 1}) * distance;
        up = rotate(turn, {0, 1, 0});
    }
    TomlValue::Table table{{.key = "position", .value = to_toml(position, key.origin)},
                           {.key = "target", .value = to_toml(target, key.origin)},
                           {.key = "up", .value = to_toml(up, key.origin)}};
    for (const auto& [field, name] :
         {std::pair{&Key::fov, "fov"}, {&Key::focus, "focus"}, {&Key::aperture, "aperture"}})
        if (key.*field) {
            TomlValue value = key.origin;
            value.data = curve([&, member = field](const Key& k) { return *(k.*member); }, is_smooth);
            table.push_back({.key = name, .value = std::move(value)});
        }
    return table;
}

}  // namespace lancer
