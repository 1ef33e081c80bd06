#include "scene/view/sheet.h"

namespace lancer {

std::optional<Vec3d> sheet_normal(const Subject& subject, const CoarseGrid& grid, const UpFrame& frame)
{
    constexpr double thinnest = 0.01, least_share = 0.95;
    // The normal that most surface has is the first eigenvector, found by repeated multiplication. Of a sheet its
    // eigenvalue is nearly the trace, so that a few steps suffice.
    const auto& [xx, yy, zz, xy, yz, zx] = grid.orientation();
    const double area = xx + yy + zz;
    if (!(area > 0)) return {};
    const Vec3d rows[3]{{xx, xy, zx}, {xy, yy, yz}, {zx, yz, zz}};
    const size_t first = xx >= yy ? (xx >= zz ? 0 : 2) : (yy >= zz ? 1 : 2);
    Vec3d n = rows[first];
    for (int step = 0; step < 8; ++step) n = normalize(Vec3d{dot(rows[0], n), dot(rows[1], n), dot(rows[2], n)});
    const Vec3d image{dot(rows[0], n), dot(rows[1], n), dot(rows[2], n)};
    if (length(image) < least_share * area) return {};
    double low = Bounds::inf, high = -Bounds::inf;
    subject.each_point([&](Vec3d p) { low = std::min(low, dot(n, p)), high = std::max(high, dot(n, p)); });
    if (high - low > thinnest) return {};
    double faces = 0, all = 0;
    subject.each_triangle([&](Vec3d a, Vec3d b, Vec3d c) {
        const double facing = dot(cross(b - a, c - a), n);
        faces += facing, all += std::abs(facing);
    });
    if (std::abs(faces) > 0.05 * all) return faces < 0 ? -n : n;
    const Vec3d seen{dot(n, frame.front), dot(n, frame.right), dot(n, frame.up)};
    return seen[largest_axis(seen)] < 0 ? -n : n;
}

}  // namespace lancer
