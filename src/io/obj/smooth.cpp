#include "io/obj/smooth.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace lancer {
namespace {

// A corner of a triangle that meets others at a vertex.
struct Meeting {
    uint32_t triangle, corner, group;
    Vec3d normal;  // of the triangle, unit
    double angle;
};

class Smoother {
public:
    Smoother(MeshData& mesh, std::span<const uint32_t> groups, double largest_deg)
        : mesh_(mesh), groups_(groups), least_cos_(std::cos(largest_deg * std::numbers::pi / 180))
    {
    }

    void run()
    {
        collect_corners();
        mesh_.normal_triangles.assign(mesh_.triangles.size(),
                                      {MeshData::no_normal, MeshData::no_normal, MeshData::no_normal});
        for (uint32_t v = 0; v < mesh_.positions.size(); ++v) smooth_vertex(v);
        mesh_.made_normals = true;
    }

private:
    // corners_[first_[v]] to corners_[first_[v + 1]]: those of smooth triangles at vertex v, three times the triangle
    // plus the corner, in the order of the file.
    void collect_corners()
    {
        first_.assign(mesh_.positions.size() + 1, 0);
        const auto for_each_corner = [&](const auto& f) {
            for (size_t t = 0; t < mesh_.triangles.size(); ++t)
                for (size_t k = 0; groups_[t] != 0 && k < 3; ++k) f(mesh_.triangles[t][k], 3 * t + k);
        };
        for_each_corner([&](uint32_t vertex, size_t) { ++first_[vertex + 1]; });
        for (size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
        corners_.resize(first_.back());
        std::vector<uint64_t> next(first_.begin(), first_.end() - 1);
        for_each_corner([&](uint32_t vertex, size_t corner) { corners_[next[vertex]++] = corner; });
    }

    Meeting meeting_at(uint64_t at) const
    {
        Meeting m{static_cast<uint32_t>(at / 3), static_cast<uint32_t>(at % 3), groups_[at / 3], {}, 0};
        const auto& t = mesh_.triangles[m.triangle];
        const auto place = [&](uint32_t k) { return mesh_.positions[t[(m.corner + k) % 3]]; };
        const Vec3d p = place(0), a = place(1) - p, b = place(2) - p;
        const double scale = std::max(max_component(abs(a)), max_component(abs(b)));
        const Vec3d n = cross(a / scale, b / scale);
        m.normal = normalize(n);
        m.angle = std::atan2(length(n), dot(a / scale, b / scale));
        return m;
    }

    void smooth_vertex(uint32_t vertex)
    {
        meetings_.clear();
        for (uint64_t i = first_[vertex]; i < first_[vertex + 1]; ++i) meetings_.push_back(meeting_at(corners_[i]));
        const size_t first = mesh_.normals.size();
        // Where very many meet, as at the tip of a fan, each is compared with none: all of a group have one normal.
        constexpr size_t most_compared = 256;
        const bool compares = meetings_.size() <= most_compared;
        uint32_t last_group = 0, last_normal = 0;
        for (const Meeting& m : meetings_) {
            if (compares || m.group != last_group) last_normal = add(normal_of(m, compares), first);
            last_group = m.group;
            mesh_.normal_triangles[m.triangle][m.corner] = last_normal;
        }
    }

    Vec3 normal_of(const Meeting& m, bool compares) const
    {
        Vec3d sum;
        for (const Meeting& other : meetings_)
            if (other.group == m.group && (!compares || dot(other.normal, m.normal) >= least_cos_))
                sum += other.normal * other.angle;
        const double size = length(sum);
        return to_float(size > 0 ? sum / size : m.normal);
    }

    // Corners that see the same triangles share a normal. first: of the vertex.
    uint32_t add(Vec3 normal, size_t first)
    {
        const auto begin = mesh_.normals.begin() + static_cast<std::ptrdiff_t>(first);
        const auto known = std::find(begin, mesh_.normals.end(), normal);
        const auto index = static_cast<uint32_t>(known - mesh_.normals.begin());
        if (known == mesh_.normals.end()) mesh_.normals.push_back(normal);
        return index;
    }

    MeshData& mesh_;
    std::span<const uint32_t> groups_;
    const double least_cos_;
    std::vector<uint64_t> first_, corners_;
    std::vector<Meeting> meetings_;
};

}  // namespace

void smooth(MeshData& mesh, std::span<const uint32_t> groups, double largest_deg)
{
    Smoother(mesh, groups, largest_deg).run();
}

}  // namespace lancer
