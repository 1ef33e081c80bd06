#include "scene/view/view_detail.h"

namespace lancer {

double visible_detail(const CoarseGrid& grid, const UpFrame& frame, Vec3d towards)
{
    std::vector<float> seen(grid.cell_count());
    const CoarseGrid::Place size = grid.size();
    const Vec3d center{0.5 * size[0], 0.5 * size[1], 0.5 * size[2]};
    const double radius = length(center);
    const int half = static_cast<int>(std::ceil(radius));
    const Vec3d across = normalize(cross(frame.upright_from(towards), towards)), along = cross(towards, across);
    double detail = 0;
    for (int i = -half; i <= half; ++i)
        for (int j = -half; j <= half; ++j)
            grid.follow(center + towards * (2 * radius) + across * (1.0 * i) + along * (1.0 * j), -towards,
                        [&](const CoarseGrid::Place& p, double, double front, double) {
                            float& most = seen[grid.index(p)];
                            const auto more = static_cast<float>(front) - most;
                            if (more <= 0) return;
                            most += more;
                            detail += static_cast<double>(more * std::sqrt(grid.at(p).triangles));
                        });
    return detail;
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
