#include "scene/view/view_detail.h"

namespace lancer {

namespace {

// What a ray from the viewer ends at.
struct Seen {
    Vec3d normal{};  // mean of what faces the viewer; unit where anything does
    double depth = 0, weight = 0;
};

Vec3d normal_towards(const CoarseGrid::Cell& cell, Vec3d towards)
{
    const auto along = [&](size_t axis, double way) {
        return way > 0 ? static_cast<double>(cell.facing[2 * axis]) : -static_cast<double>(cell.facing[2 * axis + 1]);
    };
    const Vec3d n{along(0, towards.x), along(1, towards.y), along(2, towards.z)};
    return n == Vec3d{} ? n : normalize(n);
}

// How much two neighbours differ: where the surface turns, and where one part stands before another.
double step_between(const Seen& a, const Seen& b)
{
    constexpr double least_weight = 0.3, apart = 4;  // cells
    if (a.weight < least_weight || b.weight < least_weight) return 0;
    return length(a.normal - b.normal) + (std::abs(a.depth - b.depth) > apart ? 1 : 0);
}

}  // namespace

double visible_detail(const CoarseGrid& grid, const UpFrame& frame, Vec3d towards)
{
    std::vector<float> seen(grid.cell_count());
    const CoarseGrid::Place size = grid.size();
    const Vec3d center{0.5 * size[0], 0.5 * size[1], 0.5 * size[2]};
    const double radius = length(center);
    const int half = static_cast<int>(std::ceil(radius)), side = 2 * half + 1;
    const Vec3d across = normalize(cross(frame.upright_from(towards), towards)), along = cross(towards, across);
    std::vector<Seen> picture(static_cast<size_t>(side) * static_cast<size_t>(side));
    double detail = 0;
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
            Seen& pixel = picture[static_cast<size_t>(i * side + j)];
            const Vec3d eye =
                center + towards * (2 * radius) + across * (1.0 * (i - half)) + along * (1.0 * (j - half));
            grid.follow(eye, -towards, [&](const CoarseGrid::Place& p, double depth, double front, double) {
                pixel.normal += normal_towards(grid.at(p), towards) * front;
                pixel.depth += depth * front, pixel.weight += front;
                float& most = seen[grid.index(p)];
                const auto more = static_cast<float>(front) - most;
                if (more <= 0) return;
                most += more;
                detail += static_cast<double>(more * std::sqrt(grid.at(p).triangles));
            });
            if (pixel.weight > 0) pixel.depth /= pixel.weight;
            if (pixel.normal != Vec3d{}) pixel.normal = normalize(pixel.normal);
        }
    double steps = 0;
    for (int i = 0; i + 1 < side; ++i)
        for (int j = 0; j + 1 < side; ++j) {
            const auto at = [&](int x, int y) -> const Seen& { return picture[static_cast<size_t>(x * side + y)]; };
            steps += step_between(at(i, j), at(i + 1, j)) + step_between(at(i, j), at(i, j + 1));
        }
    return detail * (1 + steps);
}

double best_azimuth(const CoarseGrid& grid, const UpFrame& frame, double elevation_deg)
{
    constexpr double equal = 0.95;
    constexpr std::array<double, 8> azimuths{30, -30, 60, -60, 150, -150, 120, -120};
    std::array<double, 8> detail{};
    for (size_t i = 0; i < azimuths.size(); ++i)
        detail[i] = visible_detail(grid, frame, frame.towards(azimuths[i], elevation_deg));
    const double most = *std::max_element(detail.begin(), detail.end());
    for (size_t i = 0; i < azimuths.size(); ++i)
        if (detail[i] >= equal * most) return azimuths[i];
    return azimuths[0];
}

}  // namespace lancer
