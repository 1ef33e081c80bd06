#include "app/defaults/key_light.h"

#include <cmath>
#include <vector>

#include "scene/placement.h"
#include "scene/view/coarse_grid.h"
#include "scene/view/up_frame.h"

namespace lancer {
namespace {

// Axes of a camera; back: towards who looks.
struct ViewFrame {
    Vec3d right, up, back;

    explicit ViewFrame(const CameraDescription& c)
        : right(normalize(cross(c.up, c.position - c.target))), back(normalize(c.position - c.target))
    {
        up = cross(back, right);
    }
};

// Places just before what is seen, units of the grid.
std::vector<Vec3d> seen_places(const CoarseGrid& grid, const Subject& subject, const CameraDescription& camera,
                               double aspect)
{
    constexpr int rows = 18, columns = 24;
    constexpr double before = 1.5;  // cells: the surface must not shadow itself
    const ViewFrame frame(camera);
    const double half = std::tan(0.5 * camera.fov_deg * pi_d / 180);
    const Vec3d eye = CoarseGrid::to_cells(subject.from_file(camera.position));
    std::vector<Vec3d> places;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const double x = (2 * (column + 0.5) / columns - 1) * half * aspect;
            const double y = (1 - 2 * (row + 0.5) / rows) * half;
            const Vec3d way = normalize(frame.right * x + frame.up * y - frame.back);
            const CoarseGrid::Sight sight = grid.look(eye, way);
            if (sight.free < 0.5 && sight.distance > before) places.push_back(eye + way * (sight.distance - before));
        }
    return places;
}

}  // namespace

bool is_inside(const SceneDescription& scene)
{
    const Bounds b = subject_bounds(scene);
    const Vec3d p = scene.camera->position;
    return p.x > b.lower.x && p.y > b.lower.y && p.z > b.lower.z && p.x < b.upper.x && p.y < b.upper.y &&
           p.z < b.upper.z;
}

Vec3d way_to_key(const SceneDescription& scene, Vec3d up, double aspect)
{
    const ViewFrame frame(*scene.camera);
    const Vec3d over_shoulder = normalize(frame.right * -0.8 + frame.up * 0.8 + frame.back * 0.45);
    if (!is_inside(scene)) return over_shoulder;
    const Subject subject(scene);
    if (!subject.is_usable()) return over_shoulder;
    const CoarseGrid grid(subject);
    const std::vector<Vec3d> places = seen_places(grid, subject, *scene.camera, aspect);
    const UpFrame world(up);
    Vec3d best = over_shoulder;
    double most = 0.02 * static_cast<double>(places.size());  // what lights less is not worth its noise
    for (const double elevation : {62.0, 48.0, 34.0})
        for (int turn = 0; turn < 16; ++turn) {
            const Vec3d way = world.towards(22.5 * turn + 11, elevation);
            double lit = 0;
            for (const Vec3d& place : places) lit += grid.look(place, way).free;
            if (lit > 1.05 * most) most = lit, best = way;
        }
    return best;
}

}  // namespace lancer
