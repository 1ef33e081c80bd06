// A subject in about 64 cells along its longest side: in each cell how much surface faces each of the six sides, and
// how many triangles. It answers what can be seen from where without an accelerator: 64 cells tell a room from a vase.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scene/view/subject.h"

namespace lancer {

class CoarseGrid {
public:
    static constexpr int longest = 64;  // cells

    explicit CoarseGrid(const Subject& subject);

    struct Cell {
        // Area in squares of a cell's side, projected onto +x, -x, +y, -y, +z, -z.
        std::array<float, 6> facing{};
        float triangles = 0;  // a triangle that crosses n cells counts 1 / n in each
        bool empty() const { return triangles == 0; }
    };
    using Place = std::array<int, 3>;

    Place size() const { return size_; }
    bool contains(Place p) const
    {
        return p[0] >= 0 && p[1] >= 0 && p[2] >= 0 && p[0] < size_[0] && p[1] < size_[1] && p[2] < size_[2];
    }
    const Cell& at(Place p) const { return cells_[index(p)]; }
    size_t index(Place p) const
    {
        return (static_cast<size_t>(p[2]) * size_[1] + static_cast<size_t>(p[1])) * size_[0] +
               static_cast<size_t>(p[0]);
    }
    size_t cell_count() const { return cells_.size(); }

    // The sum of n n^T A over all surface, with n its normal and A its area: xx, yy, zz, xy, yz, zx.
    const std::array<double, 6>& orientation() const { return orientation_; }

    // From units of the subject to cells and back.
    static constexpr Vec3d to_cells(Vec3d p) { return p * static_cast<double>(longest); }
    static constexpr Vec3d to_subject(Vec3d p) { return p / static_cast<double>(longest); }

    // Follows a ray, in units of cells; dir: unit. f(place, distance, front, back): how much of the ray's width ends
    // in this cell at surfaces that it sees from the front and from the back; all of them and what escapes add up to
    // 1. Returns what escapes.
    template <class F>
    double follow(Vec3d org, Vec3d dir, const F& f) const;

    // What a ray sees.
    struct Sight {
        double front = 0, back = 0, free = 1;  // add up to 1
        double distance = 0;                   // mean of what is not free, cells
    };
    Sight look(Vec3d org, Vec3d dir) const;

private:
    void add(Vec3d a, Vec3d b, Vec3d c);

    Place size_{};
    std::vector<Cell> cells_;
    std::array<double, 6> orientation_{};
    size_t samples_ = 0;
};

template <class F>
double CoarseGrid::follow(Vec3d org, Vec3d dir, const F& f) const
{
    double enter = 0, leave = Bounds::inf;
    for (int axis = 0; axis < 3; ++axis) {
        const double o = org[axis], d = dir[axis], side = size_[axis];
        if (d == 0) {
            if (o < 0 || o > side) return 1;
            continue;
        }
        const double near = ((d > 0 ? 0 : side) - o) / d, far = ((d > 0 ? side : 0) - o) / d;
        enter = std::max(enter, near), leave = std::min(leave, far);
    }
    if (!(enter <= leave)) return 1;
    Place place;
    std::array<int, 3> step;
    std::array<double, 3> next, stride;
    for (int axis = 0; axis < 3; ++axis) {
        const double at = org[axis] + dir[axis] * enter;
        place[axis] = std::clamp(static_cast<int>(std::floor(at)), 0, size_[axis] - 1);
        step[axis] = dir[axis] > 0 ? 1 : -1;
        stride[axis] = dir[axis] == 0 ? Bounds::inf : std::abs(1 / dir[axis]);
        next[axis] = dir[axis] == 0 ? Bounds::inf : (place[axis] + (dir[axis] > 0 ? 1 : 0) - org[axis]) / dir[axis];
    }
    const double x = std::abs(dir.x), y = std::abs(dir.y), z = std::abs(dir.z);
    const int fx = dir.x > 0 ? 1 : 0, fy = dir.y > 0 ? 3 : 2, fz = dir.z > 0 ? 5 : 4;  // what faces the ray
    double left = 1, t = enter;
    while (left > 0) {
        if (const Cell& cell = at(place); !cell.empty()) {
            const double front = cell.facing[fx] * x + cell.facing[fy] * y + cell.facing[fz] * z;
            const double back = cell.facing[fx ^ 1] * x + cell.facing[fy ^ 1] * y + cell.facing[fz ^ 1] * z;
            // A wall or a column thinner than a cell is seen from the front.
            const double ends_front = std::min(left, front), ends_back = std::min(left - ends_front, back);
            f(place, t, ends_front, ends_back);
            left -= ends_front + ends_back;
        }
        const int axis = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
        t = next[axis];
        next[axis] += stride[axis];
        place[axis] += step[axis];
        if (place[axis] < 0 || place[axis] >= size_[axis]) break;
    }
    return left;
}

}  // namespace lancer
