#include "harness/generate.h"

#include <cmath>
#include <map>

#include "support/random.h"
#include "support/scenes/scenes.h"

namespace lancer::bench {
namespace {

// Sums of waves, rougher by octaves, in about [-1, 1].
double waves(double x, double y)
{
    double sum = 0, part = 0.5, frequency = 1;
    for (int octave = 0; octave < 6; ++octave) {
        sum += part * std::sin(frequency * x + octave) * std::cos(frequency * y + 2 * octave);
        part *= 0.5, frequency *= 2.1;
    }
    return sum;
}

void append(MeshData& to, const MeshData& mesh, Vec3d at, double scale)
{
    const auto first = static_cast<uint32_t>(to.positions.size());
    for (const Vec3d& p : mesh.positions) to.positions.push_back(at + p * scale);
    for (const auto& t : mesh.triangles) to.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

}  // namespace

MeshPointer make_displaced_sphere(uint64_t triangles)
{
    const auto rows = static_cast<uint32_t>(std::lround(std::sqrt(static_cast<double>(triangles) / 4))) + 1;
    return make_uv_sphere(rows, 2 * rows, 0.2);
}

MeshPointer make_terrain(uint64_t triangles)
{
    const auto side = static_cast<uint32_t>(std::lround(std::sqrt(static_cast<double>(triangles) / 2)));
    std::vector<Vec3d> p;
    std::vector<std::array<uint32_t, 3>> t;
    for (uint32_t j = 0; j <= side; ++j)
        for (uint32_t i = 0; i <= side; ++i) {
            const double x = 2.0 * i / side - 1, z = 2.0 * j / side - 1;
            p.push_back({x, 0.3 * waves(5 * x, 5 * z), z});
        }
    const auto at = [&](uint32_t i, uint32_t j) { return j * (side + 1) + i; };
    for (uint32_t j = 0; j < side; ++j)
        for (uint32_t i = 0; i < side; ++i) {
            t.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
            t.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
        }
    return make_mesh_data(std::move(p), std::move(t));
}

MeshPointer make_room(uint64_t triangles)
{
    constexpr uint32_t balls = 400;
    MeshData room = *make_cube();
    for (auto& t : room.triangles) std::swap(t[1], t[2]);  // seen from within
    const auto ball = make_displaced_sphere(triangles / balls);
    Random random(5);
    for (uint32_t i = 0; i < balls; ++i) {
        const double size = random.uniform(0.01, 0.08);
        append(room, *ball, random.point(-0.9, 0.9), size);
    }
    return std::make_shared<const MeshData>(std::move(room));
}

MeshPointer subdivide(const MeshData& mesh, unsigned levels)
{
    MeshData now;
    now.positions = mesh.positions, now.triangles = mesh.triangles, now.materials.emplace_back();
    for (unsigned level = 0; level < levels; ++level) {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
        const auto middle = [&](uint32_t a, uint32_t b) {
            const auto [it, fresh] =
                middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(now.positions.size()));
            if (fresh) now.positions.push_back((now.positions[a] + now.positions[b]) * 0.5);
            return it->second;
        };
        std::vector<std::array<uint32_t, 3>> finer;
        finer.reserve(4 * now.triangles.size());
        for (const auto& [a, b, c] : now.triangles) {
            const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        now.triangles = std::move(finer);
    }
    return std::make_shared<const MeshData>(std::move(now));
}

}  // namespace lancer::bench
