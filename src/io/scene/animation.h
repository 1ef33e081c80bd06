// [animation] of a scene file: tracks, each with the values of one key of the file at some frames. Values in between
// are put into the tree of the file before its tables are read, as -D does: so whatever a key allows, a track may give,
// and mistakes have the place of the value.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/scene/definition.h"
#include "io/scene/view_keys.h"
#include "scene/description/description.h"

namespace lancer {

enum class Interpolation { linear, smooth, step };
template <>
inline constexpr auto enum_names<Interpolation> = std::to_array<std::string_view>({"linear", "smooth", "step"});

// One [[animation.track]].
struct AnimationTrack {
    std::vector<std::string> path;  // of the key; lists by number
    std::vector<double> times;      // frames, ascending
    std::vector<TomlValue> values;  // parallel; all are numbers, or lists of as many, unless it steps
    Interpolation interpolation = Interpolation::linear;
    std::optional<ViewKeys> views;  // of a whole camera; values are not used then
    bool is_direction = false;      // turns evenly
    bool rounds = false;            // gives whole numbers

    // Whether it changes nothing of a scene but from where it is seen.
    bool moves_view() const;
    // Whether it moves a thing: its place is a Place of geometry/motion.h.
    bool moves_thing() const;
};

// A value that a frame has in place of the file's.
struct FrameValue {
    std::vector<std::string> path;
    TomlValue value;
    bool moves_view = false;
};

class Animation {
public:
    // Of the tree of a file; nothing if it has no [animation]. What is wrong goes to problems.
    static std::optional<Animation> read(const TomlValue& root, TomlProblems& problems);

    const AnimationDescription& description() const { return description_; }
    // Whether any track moves a camera.
    bool moves_views() const;
    // Whether any moves a thing.
    bool moves_things() const;
    // Numbers of the tables of a list, "mesh" or "instance", that any moves; ascending.
    std::vector<size_t> moved_of(std::string_view list) const;
    // time: in frames. since: when the shutter has opened; what goes in steps stays as it was then, since a cut is no
    // motion.
    std::vector<FrameValue> values_at(double time, std::optional<double> since = {}) const;

private:
    void read_track(const TomlTable& table, const TomlValue& root, TomlProblems& problems);

    AnimationDescription description_;
    std::vector<AnimationTrack> tracks_;
};

}  // namespace lancer
