#include "scene/view/up_axis.h"

namespace lancer {
namespace {

// How much of the footprint lies between the faces that rest on the plane below: of the box around them, for each axis.
std::array<double, 3> footprints(const Subject& subject)
{
    constexpr double flat = 0.003;      // of the longest side
    constexpr double downwards = 0.95;  // cosine
    std::array<Bounds, 3> resting;
    subject.each_triangle([&](Vec3d a, Vec3d b, Vec3d c) {
        for (int axis = 1; axis < 3; ++axis) {
            if (a[axis] > flat || b[axis] > flat || c[axis] > flat) continue;
            const Vec3d normal = cross(b - a, c - a);
            if (std::abs(normal[axis]) < downwards * length(normal)) continue;
            for (const Vec3d p : {a, b, c}) resting[static_cast<size_t>(axis)].grow(p);
        }
    });
    const Vec3d size = subject.size();
    std::array<double, 3> shares{};
    for (int axis = 1; axis < 3; ++axis) {
        const Bounds& b = resting[static_cast<size_t>(axis)];
        if (b.empty()) continue;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const double whole = size[u] * size[v];
        if (whole > 0) shares[static_cast<size_t>(axis)] = (b.upper - b.lower)[u] * (b.upper - b.lower)[v] / whole;
    }
    return shares;
}

// How much of the surface has its like on the other side of the middle, 0 to 1: at a quarter of the resolution, as no
// object is exactly even.
double symmetry(const CoarseGrid& grid, int axis)
{
    constexpr int coarse = 4;
    const CoarseGrid::Place size = grid.size();
    CoarseGrid::Place blocks;
    for (size_t i = 0; i < 3; ++i) blocks[i] = (size[i] + coarse - 1) / coarse;
    std::vector<double> area(static_cast<size_t>(blocks[0]) * static_cast<size_t>(blocks[1]) *
                             static_cast<size_t>(blocks[2]));
    const auto index = [&](const CoarseGrid::Place& p) {
        return static_cast<size_t>((p[2] * blocks[1] + p[1]) * blocks[0] + p[0]);
    };
    const size_t mirrored = static_cast<size_t>(axis);
    std::vector<double> image(area.size());
    for (int z = 0; z < size[2]; ++z)
        for (int y = 0; y < size[1]; ++y)
            for (int x = 0; x < size[0]; ++x) {
                CoarseGrid::Place p{x, y, z};
                const CoarseGrid::Cell& cell = grid.at(p);
                if (cell.empty()) continue;
                double sum = 0;
                for (const float facing : cell.facing) sum += static_cast<double>(facing);
                const auto add = [&](std::vector<double>& to) {
                    to[index({p[0] / coarse, p[1] / coarse, p[2] / coarse})] += sum;
                };
                add(area);
                p[mirrored] = size[mirrored] - 1 - p[mirrored];
                add(image);
            }
    double common = 0, all = 0;
    for (size_t i = 0; i < area.size(); ++i) common += std::min(area[i], image[i]), all += std::max(area[i], image[i]);
    return all > 0 ? common / all : 1;
}

}  // namespace

UpGuess guess_up(const Subject& subject, const CoarseGrid& grid)
{
    const Vec3d size = subject.size();
    if (std::min(size.y, size.z) < 0.01) return {};  // a sheet stands for nothing
    int for_y = 0, for_z = 0;
    std::string why;
    const auto sign = [&](bool y, bool z, const char* what) {
        for_y += y ? 1 : 0, for_z += z ? 1 : 0;
        if (z) why += (why.empty() ? "" : ", ") + std::string(what);
    };
    // Programs put objects on the ground, z = 0, and their middle over the origin.
    const Vec3d origin = subject.from_file({0, 0, 0});
    const auto stands = [&](int axis) { return std::abs(origin[axis]) < 0.005; };
    const auto straddles = [&](int axis) {
        return origin[axis] > 0.25 * size[axis] && origin[axis] < 0.75 * size[axis];
    };
    const bool on_z = stands(2) && straddles(1), on_y = stands(1) && straddles(2);
    sign(on_y, on_z, "it begins at z = 0");
    sign(on_y && size.y > 1.5 * size.z, on_z && size.z > 1.5 * size.y, "it is tall");
    // What stands differs above and below, and is often alike in front and behind.
    constexpr double clearly = 0.25;
    const double even_y = symmetry(grid, 1), even_z = symmetry(grid, 2);
    sign(even_z - even_y > clearly, even_y - even_z > clearly, "its upper and lower halves differ most along z");
    if (for_z < 1 || for_y > 0) return {};
    const std::array<double, 3> resting = footprints(subject);
    constexpr double least_base = 0.05, several = 4;
    sign(resting[1] > least_base && resting[1] > several * resting[2],
         resting[2] > least_base && resting[2] > several * resting[1], "it stands flat");
    if (for_z < 2 || for_y > 0) return {};
    return {true, why};
}

}  // namespace lancer
