#include "scene/view/coarse_grid.h"

namespace lancer {
namespace {

// Of surface elements, two along the side of a cell. Past the first number they become coarser, so that a mesh of a
// million triangles as large as the scene takes no longer than others.
constexpr size_t usual_samples = 1 << 22;
constexpr double usual_spacing = 0.5, coarse_spacing = 4;

}  // namespace

CoarseGrid::CoarseGrid(const Subject& subject)
{
    const Vec3d side = to_cells(subject.size());
    for (int axis = 0; axis < 3; ++axis) size_[axis] = std::clamp(static_cast<int>(std::ceil(side[axis])), 1, longest);
    cells_.resize(static_cast<size_t>(size_[0]) * size_[1] * size_[2]);
    subject.each_triangle([&](Vec3d a, Vec3d b, Vec3d c) { add(to_cells(a), to_cells(b), to_cells(c)); });
}

void CoarseGrid::add(Vec3d a, Vec3d b, Vec3d c)
{
    const Vec3d normal = cross(b - a, c - a) * 0.5;  // its length is the area
    if (const double area = length(normal); area > 0) {
        const Vec3d n = normal / area;
        const std::array<double, 6> products{n.x * normal.x, n.y * normal.y, n.z * normal.z,
                                             n.x * normal.y, n.y * normal.z, n.z * normal.x};
        for (size_t i = 0; i < 6; ++i) orientation_[i] += products[i];
    }
    // Elements lie along the two edges that meet at the corner opposite to the longest one.
    const double ab = dot(b - a, b - a), bc = dot(c - b, c - b), ca = dot(a - c, a - c);
    Vec3d corner = a, u = b - a, v = c - a;
    if (ab >= bc && ab >= ca) {
        corner = c, u = a - c, v = b - c;
    } else if (ca >= bc) {
        corner = b, u = c - b, v = a - b;
    }
    const double spacing = samples_ < usual_samples ? usual_spacing : coarse_spacing;
    const auto count = [&](Vec3d edge) { return std::max(1, static_cast<int>(std::ceil(length(edge) / spacing))); };
    const int rows = count(u), columns = count(v);
    const double part = 1.0 / (static_cast<double>(rows) * columns);
    const Vec3d element = normal * part;
    samples_ += static_cast<size_t>(rows) * static_cast<size_t>(columns);
    const auto place = [&](Vec3d p) {
        const auto along = [&](double x, int n) { return std::clamp(static_cast<int>(x), 0, n - 1); };
        return Place{along(p.x, size_[0]), along(p.y, size_[1]), along(p.z, size_[2])};
    };
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            double s = (row + 0.5) / rows, t = (column + 0.5) / columns;
            if (s + t > 1) s = 1 - s, t = 1 - t;  // the parallelogram folded onto the triangle
            const Vec3d p = rows * columns == 1 ? corner + (u + v) / 3.0 : corner + u * s + v * t;
            Cell& cell = cells_[index(place(p))];
            for (int axis = 0; axis < 3; ++axis)
                cell.facing[2 * axis + (element[axis] < 0 ? 1 : 0)] += static_cast<float>(std::abs(element[axis]));
            cell.triangles += static_cast<float>(part);
        }
}

CoarseGrid::Sight CoarseGrid::look(Vec3d org, Vec3d dir) const
{
    Sight sight;
    double weighted = 0;
    sight.free = follow(org, dir, [&](Place, double distance, double front, double back) {
        sight.front += front, sight.back += back, weighted += distance * (front + back);
    });
    if (sight.free < 1) sight.distance = weighted / (1 - sight.free);
    return sight;
}

}  // namespace lancer
