#include "app/defaults/default_ground.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/defaults/key_light.h"
#include "scene/placement.h"

namespace lancer {
namespace {

constexpr double gap = 1e-4;        // of the mesh's extent, below it: faces in the ground's plane would fight with it
constexpr int side = 64;            // cells of the map of heights
constexpr double near_foot = 0.02;  // of the mesh's height: what lies so deep is its foot
constexpr double flat = 1e-3;       // of the extent: a mesh no higher than that is all foot
constexpr double least_foot = 0.9, least_open = 1 / 3.0;  // parts of the mesh's outline from above that make a floor

// The world with `up` as the third axis.
struct Upright {
    Vec3d x, y, z;

    explicit Upright(Vec3d up) : z(up)
    {
        const Vec3d a = abs(up);
        const Vec3d least = a.x <= a.y && a.x <= a.z ? Vec3d{1, 0, 0} : a.y <= a.z ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
        x = normalize(cross(least, up)), y = cross(z, x);
    }
    Vec3d operator()(Vec3d p) const { return {dot(p, x), dot(p, y), dot(p, z)}; }
};

// f(a, b, c) for the triangles of all meshes in the world, upright.
template <class F>
void for_each_triangle(const SceneDescription& scene, const Upright& upright, const F& f)
{
    for (const MeshDescription& mesh : scene.meshes) {
        const Transform place = to_transform(mesh.transform);
        std::vector<Vec3d> points;
        for (const Vec3d& p : mesh.data->positions) points.push_back(upright(place.point(p)));
        for (const auto& t : mesh.data->triangles) f(points[t[0]], points[t[1]], points[t[2]]);
    }
}

// Lowest and highest place of the mesh in each cell of its outline seen from above.
class HeightMap {
public:
    explicit HeightMap(const Bounds& b) : bounds_(b), cells_(size_t{side} * side) {}

    void add(Vec3d a, Vec3d b, Vec3d c)
    {
        for (const Vec3d p : {a, b, c}) grow(column_of(p.x), row_of(p.y), p.z);
        const auto [x0, x1] = std::minmax({column_of(a.x), column_of(b.x), column_of(c.x)});
        const auto [y0, y1] = std::minmax({row_of(a.y), row_of(b.y), row_of(c.y)});
        const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if (area == 0) return;
        for (int row = y0; row <= y1; ++row)
            for (int column = x0; column <= x1; ++column) {
                const double x = bounds_.lower.x + (column + 0.5) * (bounds_.upper.x - bounds_.lower.x) / side;
                const double y = bounds_.lower.y + (row + 0.5) * (bounds_.upper.y - bounds_.lower.y) / side;
                const double v = ((x - a.x) * (c.y - a.y) - (y - a.y) * (c.x - a.x)) / area;
                const double w = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
                if (v >= 0 && w >= 0 && v + w <= 1) grow(column, row, a.z + v * (b.z - a.z) + w * (c.z - a.z));
            }
    }
    bool shows_floor() const
    {
        const double height = bounds_.upper.z - bounds_.lower.z;
        const double foot = bounds_.lower.z + (height <= flat * bounds_.extent() ? height : near_foot * height);
        int all = 0, at_foot = 0, open = 0;
        for (const Cell& c : cells_)
            all += c.lowest <= c.highest, at_foot += c.lowest <= foot,
                open += c.highest <= foot && c.lowest <= c.highest;
        return at_foot >= least_foot * all && open >= least_open * all;
    }

private:
    struct Cell {
        double lowest = Bounds::inf, highest = -Bounds::inf;
    };
    static int cell_of(double x, double from, double to)
    {
        return to > from ? std::clamp(static_cast<int>((x - from) / (to - from) * side), 0, side - 1) : 0;
    }
    int column_of(double x) const { return cell_of(x, bounds_.lower.x, bounds_.upper.x); }
    int row_of(double y) const { return cell_of(y, bounds_.lower.y, bounds_.upper.y); }
    void grow(int column, int row, double z)
    {
        Cell& c = cells_[static_cast<size_t>(row * side + column)];
        c.lowest = std::min(c.lowest, z), c.highest = std::max(c.highest, z);
    }

    Bounds bounds_;
    std::vector<Cell> cells_;
};

Bounds upright_bounds(const SceneDescription& scene, const Upright& upright)
{
    Bounds b;
    for_each_triangle(scene, upright, [&](Vec3d p, Vec3d q, Vec3d r) { b.grow(p), b.grow(q), b.grow(r); });
    return b;
}

std::string unused_name(const SceneDescription& scene, std::string name)
{
    const auto is_used = [&] {
        return std::any_of(scene.materials.begin(), scene.materials.end(),
                           [&](const MaterialDescription& m) { return m.name == name; });
    };
    while (is_used()) name += "_";
    return name;
}

}  // namespace

bool wants_ground(const SceneDescription& scene, const DefaultView& view)
{
    if (!scene.planes.empty() || !scene.instances.empty() || is_inside(scene)) return false;
    if (view.kind == SubjectKind::sheet || view.kind == SubjectKind::open_box) return false;
    const Upright upright(view.up);
    const Bounds b = upright_bounds(scene, upright);
    const Vec3d eye = upright(scene.camera->position);
    if (!(b.extent() > 0) || eye.z <= b.lower.z) return false;
    HeightMap map(b);
    for_each_triangle(scene, upright, [&](Vec3d p, Vec3d q, Vec3d r) { map.add(p, q, r); });
    return !map.shows_floor();
}

void add_ground(SceneDescription& scene, Vec3d up, Color albedo)
{
    const Upright upright(up);
    const Bounds b = upright_bounds(scene, upright);
    const Vec3d foot{b.center().x, b.center().y, b.lower.z - gap * b.extent()};
    MaterialDescription material;
    material.name = unused_name(scene, "ground"), material.where = {scene.file}, material.base_color = albedo;
    PlaneDescription plane;
    plane.where = {scene.file}, plane.material = material.name;
    plane.point = upright.x * foot.x + upright.y * foot.y + upright.z * foot.z, plane.normal = up;
    scene.materials.push_back(std::move(material));
    scene.planes.push_back(std::move(plane));
}

}  // namespace lancer
