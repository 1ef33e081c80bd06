// Key frames of a whole camera in [animation]: its place moves along a curve, its orientation turns evenly from key to
// key.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/key_curve.h"
#include "core/quaternion.h"
#include "io/toml_reader.h"

namespace lancer {

class ViewKeys {
public:
    // values: of a track, each the name of a [camera.NAME] or a table with the keys of a camera. cameras: the [camera]
    // of the file, or null. Nothing after a problem.
    static std::optional<ViewKeys> read(const TomlValue::Array& values, const TomlValue* cameras,
                                        TomlProblems& problems);

    // The keys of [camera] at a time. times: of the values, ascending.
    TomlValue::Table at(std::span<const double> times, KeyPlace place, bool is_smooth) const;

private:
    struct Key {
        Vec3d position{}, target{}, up{};
        Quaternion turn;  // of right, up and back
        std::optional<double> fov, focus, aperture;
        TomlValue origin;  // its place in the file
    };
    static std::optional<Key> read_key(const TomlTable& table);

    std::vector<Key> keys_;
};

// The keys that a view moves.
inline constexpr std::array<std::string_view, 6> view_key_names{"position", "target", "up", "fov", "focus", "aperture"};

}  // namespace lancer
