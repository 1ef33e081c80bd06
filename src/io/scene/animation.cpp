#include "io/scene/animation.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "io/scene/animation_target.h"

namespace lancer {
namespace {

// The numbers of a value; empty if it is neither a number nor a list of them.
std::vector<double> numbers_of(const TomlValue& value)
{
    if (const auto* x = std::get_if<double>(&value.data)) return {*x};
    if (const auto* i = std::get_if<int64_t>(&value.data)) return {static_cast<double>(*i)};
    std::vector<double> all;
    if (const auto* list = std::get_if<TomlValue::Array>(&value.data))
        for (const TomlValue& element : *list) {
            const bool is_list = std::holds_alternative<TomlValue::Array>(element.data);
            const std::vector<double> one = is_list ? std::vector<double>{} : numbers_of(element);
            if (one.empty()) return {};
            all.push_back(one[0]);
        }
    return all;
}

bool is_list(const TomlValue& value) { return std::holds_alternative<TomlValue::Array>(value.data); }

bool is_whole(const TomlValue& value)
{
    const auto* list = std::get_if<TomlValue::Array>(&value.data);
    return list ? std::all_of(list->begin(), list->end(), is_whole) : std::holds_alternative<int64_t>(value.data);
}

// Numbers with the place and the form of another value. rounds: to whole numbers.
TomlValue like(const TomlValue& form, const std::vector<double>& numbers, bool rounds)
{
    const auto one = [&](double x) {
        TomlValue value{.line = form.line, .column = form.column, .data = x, .source = form.source};
        if (rounds) value.data = static_cast<int64_t>(std::llround(x));
        return value;
    };
    if (!is_list(form)) return one(numbers[0]);
    TomlValue::Array list;
    for (const double x : numbers) list.push_back(one(x));
    return {.line = form.line, .column = form.column, .data = std::move(list), .source = form.source};
}

void read_whole(const TomlTable& table, AnimationDescription& d)
{
    const std::vector<double> ends = table.require("frames") ? table.numbers("frames") : std::vector<double>{};
    constexpr double most = 1e6;
    const auto is_frame = [&](double x) { return x >= 0 && x <= most && x == std::floor(x); };
    if (ends.size() == 2 && is_frame(ends[0]) && is_frame(ends[1]) && ends[0] <= ends[1])
        d.first = static_cast<uint32_t>(ends[0]), d.last = static_cast<uint32_t>(ends[1]), d.frame = ends[0];
    else if (!ends.empty())
        table.error("frames", " must be the first and the last frame, from 0 to 1000000, such as [1, 48]");
    constexpr NumberRule rate{[](double x) { return x > 0 && x <= 1000; }, "greater than 0 and at most 1000"};
    d.fps = table.number("fps", rate).value_or(d.fps);
    constexpr NumberRule part{[](double x) { return x >= 0 && x <= 1; }, "from 0 to 1"};
    d.shutter = table.number("shutter", part).value_or(d.shutter);
}

// Whether each is a number, or each a list of as many numbers.
bool are_numbers(const TomlTable& table, const std::vector<TomlValue>& values, TomlProblems& problems)
{
    const size_t count = numbers_of(values[0]).size();
    for (const TomlValue& value : values) {
        const std::vector<double> numbers = numbers_of(value);
        if (!numbers.empty() && numbers.size() == count && is_list(value) == is_list(values[0])) continue;
        problems.add(problems.where(value), "'values' in " + table.label() +
                                                " must be numbers, or lists of as many numbers; others need "
                                                "interpolation = \"step\"");
        return false;
    }
    return true;
}

bool is_view_path(const std::vector<std::string>& path, const TomlValue& root)
{
    if (path[0] != "camera" || path.size() > 2) return false;
    if (path.size() == 1) return true;
    if (std::find(view_key_names.begin(), view_key_names.end(), path[1]) != view_key_names.end()) return false;
    for (const TomlEntry& e : std::get<TomlValue::Table>(root.data))
        if (const auto* cameras = std::get_if<TomlValue::Table>(&e.value.data); cameras && e.key == "camera")
            for (const TomlEntry& named : *cameras)
                if (named.key == path[1]) return std::holds_alternative<TomlValue::Table>(named.value.data);
    return false;
}

const TomlValue* camera_of(const TomlValue& root)
{
    for (const TomlEntry& e : std::get<TomlValue::Table>(root.data))
        if (e.key == "camera") return &e.value;
    return nullptr;
}

}  // namespace

bool AnimationTrack::moves_view() const
{
    return path[0] == "camera" &&
           (views || std::find(view_key_names.begin(), view_key_names.end(), path.back()) != view_key_names.end());
}

bool AnimationTrack::moves_thing() const
{
    if (path.size() < 3) return false;
    const auto is_one_of = [](const std::string& name, std::initializer_list<std::string_view> names) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    return (is_one_of(path[0], {"mesh", "instance"}) && is_one_of(path[2], {"translate", "rotate", "scale"})) ||
           (is_one_of(path[0], {"sphere", "bubble"}) && is_one_of(path[2], {"center", "radius"}));
}

std::optional<Animation> Animation::read(const TomlValue& root, TomlProblems& problems)
{
    const std::optional<TomlTable> table = TomlTable(root, "", problems).table("animation");
    if (!table) return {};
    table->allow({"frames", "fps", "shutter", "track"});
    Animation animation;
    read_whole(*table, animation.description_);
    for (const TomlTable& track : table->tables("track")) animation.read_track(track, root, problems);
    return animation;
}

void Animation::read_track(const TomlTable& table, const TomlValue& root, TomlProblems& problems)
{
    table.allow({"key", "frames", "values", "interpolation"});
    if (!table.require("key") || !table.require("frames") || !table.require("values")) return;
    const std::optional<std::string> key = table.text("key");
    AnimationTrack track;
    track.times = table.numbers("frames");
    const auto* values = std::get_if<TomlValue::Array>(&table.value("values")->data);
    if (!values) table.error("values", " must be a list, with a value for each of 'frames'");
    if (!key || track.times.empty() || !values) return;
    if (!std::is_sorted(track.times.begin(), track.times.end(), std::less_equal<>{}))
        return table.error("frames", " must be in ascending order, each once");
    if (values->size() != track.times.size())
        return table.error("values", " must be as many as 'frames': " + std::to_string(track.times.size()) + ", not " +
                                         std::to_string(values->size()));
    auto path = find_target(root, *key, table.where("key"), problems);
    if (!path) return;
    track.path = std::move(*path);
    for (const AnimationTrack& other : tracks_)
        if (other.path == track.path)
            return table.error("key", ": another track moves " + in_quotes(*key) + " already");
    const bool is_view = is_view_path(track.path, root);
    const NameList names{enum_names<Interpolation>.begin(), enum_names<Interpolation>.end()};
    const auto usual = is_view ? Interpolation::smooth : Interpolation::linear;
    const std::optional<size_t> choice = table.choice("interpolation", names, static_cast<size_t>(usual));
    if (!choice) return;
    track.interpolation = static_cast<Interpolation>(*choice);
    if (is_view) {
        track.views = ViewKeys::read(*values, camera_of(root), problems);
        if (!track.views) return;
    } else if (track.interpolation != Interpolation::step && !are_numbers(table, *values, problems)) {
        return;
    }
    track.values = *values;
    track.is_direction = track.path.back() == "direction" && track.interpolation != Interpolation::step &&
                         numbers_of(values->front()).size() == 3;
    // Samples, seed and the like are whole numbers.
    track.rounds = track.path[0] == "render" && std::all_of(values->begin(), values->end(), is_whole);
    description_.moves_views_only = description_.moves_views_only && track.moves_view();
    const bool is_of_scene = track.path[0] != "render" && track.path[0] != "output";
    description_.blurs_all = description_.blurs_all && (track.moves_view() || track.moves_thing() || !is_of_scene);
    tracks_.push_back(std::move(track));
}

bool Animation::moves_views() const
{
    return std::any_of(tracks_.begin(), tracks_.end(), [](const AnimationTrack& t) { return t.moves_view(); });
}

bool Animation::moves_things() const
{
    return std::any_of(tracks_.begin(), tracks_.end(), [](const AnimationTrack& t) { return t.moves_thing(); });
}

std::vector<size_t> Animation::moved_of(std::string_view list) const
{
    std::vector<size_t> numbers;
    for (const AnimationTrack& t : tracks_)
        if (t.moves_thing() && t.path[0] == list) numbers.push_back(std::stoull(t.path[1]));
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return numbers;
}

std::vector<FrameValue> Animation::values_at(double time, std::optional<double> since) const
{
    std::vector<FrameValue> all;
    for (const AnimationTrack& track : tracks_) {
        const bool is_step = track.interpolation == Interpolation::step;
        KeyPlace place = place_among(track.times, is_step ? since.value_or(time) : time);
        if (is_step) place.u = 0;
        if (track.views) {
            const bool is_smooth = track.interpolation == Interpolation::smooth;
            for (TomlEntry& e : track.views->at(track.times, place, is_smooth)) {
                FrameValue& own = all.emplace_back(FrameValue{track.path, std::move(e.value), true});
                own.path.push_back(e.key);
            }
            continue;
        }
        FrameValue& own = all.emplace_back(FrameValue{track.path, track.values[place.at], track.moves_view()});
        if (place.u == 0) continue;
        std::vector<std::vector<double>> keys;
        for (const TomlValue& value : track.values) keys.push_back(numbers_of(value));
        std::vector<double> result(keys[0].size()), column(keys.size());
        for (size_t i = 0; i < result.size(); ++i) {
            std::transform(keys.begin(), keys.end(), column.begin(), [&](const auto& key) { return key[i]; });
            result[i] = track.interpolation == Interpolation::smooth ? smooth_at(track.times, column, place)
                                                                     : linear_at(column, place);
        }
        if (track.is_direction) {
            const auto direction = [&](size_t at) { return normalize(Vec3d{keys[at][0], keys[at][1], keys[at][2]}); };
            const Vec3d turned = slerp(direction(place.at), direction(place.at + 1), place.u);
            // The zero vector has no direction; the reader of its table says so.
            if (is_finite(turned)) result = {turned.x, turned.y, turned.z};
        }
        own.value = like(track.values[place.at], result, track.rounds);
    }
    return all;
}

}  // namespace lancer
