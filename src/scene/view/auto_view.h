// The view of a scene that says nothing, or not all, of its camera: for lancer's default, --up and --view.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/enum_names.h"
#include "scene/description/description.h"

namespace lancer {

enum class UpChoice { y, z, automatic };
template <>
inline constexpr auto enum_names<UpChoice> = std::to_array<std::string_view>({"y", "z", "auto"});

// Towards the viewer, degrees: azimuth from the front to the right, elevation above the horizon in [-90, 90].
struct ViewDirection {
    double azimuth_deg = 0, elevation_deg = 0;
};
struct NamedView {
    std::string_view name;
    ViewDirection direction;
};
inline constexpr std::array<NamedView, 5> named_views{
    {{"front", {0, 0}}, {"back", {180, 0}}, {"left", {-90, 0}}, {"right", {90, 0}}, {"top", {0, 90}}}};

struct ViewWish {
    UpChoice up = UpChoice::y;               // where the camera does not say it
    std::optional<ViewDirection> direction;  // none: chosen by what there is to see
    bool wants_kind = false;                 // also where the view does not depend on it
};

enum class SubjectKind {
    object,    // seen from outside
    sheet,     // flat: seen from its front
    open_box,  // a room without one wall: seen through it
    interior,  // a room: seen from inside
};

struct AutoView {
    CameraDescription camera;                // complete
    Vec3d up{0, 1, 0};                       // of the scene, unit; that of the camera differs if it looks straight down
    SubjectKind kind = SubjectKind::object;  // where it was found
    std::vector<std::string> reasons;        // what was decided and why, one line each
};

// Completes what `camera` says is missing; what it gives is kept, but an `up` along the view is turned. aspect: width
// over height.
AutoView choose_view(const SceneDescription& scene, const CameraDescription& camera, const ViewWish& wish,
                     double aspect);

}  // namespace lancer
