#include "reference/tangents.h"

#include <algorithm>
#include <set>

namespace reference {
namespace {

struct Corner {
    lancer::Vec3d p;
    lancer::Vec3 n;
    lancer::Vec2 uv;
    friend bool operator==(const Corner&, const Corner&) = default;
};

class Walker {
public:
    explicit Walker(const lancer::MeshData& data) : d_(data) {}

    Corner corner(uint32_t t, uint32_t k) const
    {
        const lancer::Vec3d p = d_.positions[d_.triangles[t][k % 3]];
        const bool flat = d_.normals.empty() || d_.normal_triangles[t][0] == lancer::MeshData::no_normal;
        const lancer::Vec3 n = flat ? lancer::Vec3{} : d_.normals[d_.normal_triangles[t][k % 3]];
        return {p, n, d_.uvs[d_.uv_triangles[t][k % 3]]};
    }
    Vec normal(uint32_t t, uint32_t k) const
    {
        const lancer::Vec3 n = corner(t, k).n;
        return n == lancer::Vec3{} ? unit(cross(edge(t, 0, 1), edge(t, 0, 2))) : vec(n);
    }
    Vec edge(uint32_t t, uint32_t from, uint32_t to) const { return vec(corner(t, to).p) - vec(corner(t, from).p); }
    // Twice the area in the picture; its sign is the orientation.
    double area(uint32_t t) const
    {
        if (d_.uv_triangles[t][0] == lancer::MeshData::no_uv) return 0;
        const auto u = [&](uint32_t k) { return double{corner(t, k).uv.x} - double{corner(t, 0).uv.x}; };
        const auto v = [&](uint32_t k) { return double{corner(t, k).uv.y} - double{corner(t, 0).uv.y}; };
        return u(1) * v(2) - u(2) * v(1);
    }
    Vec along(uint32_t t) const
    {
        const auto v = [&](uint32_t k) { return double{corner(t, k).uv.y} - double{corner(t, 0).uv.y}; };
        return unit((edge(t, 0, 1) * v(2) - edge(t, 0, 2) * v(1)) * (area(t) < 0 ? -1.0 : 1.0));
    }
    // The corners in the same place that can be reached over edges between triangles of one orientation.
    std::set<std::pair<uint32_t, uint32_t>> around(uint32_t t, uint32_t k) const
    {
        std::set<std::pair<uint32_t, uint32_t>> found{{t, k}};
        std::vector<std::pair<uint32_t, uint32_t>> open{{t, k}};
        while (!open.empty()) {
            const auto [a, i] = open.back();
            open.pop_back();
            for (uint32_t b = 0; b < d_.triangles.size(); ++b) {
                if (b == a || area(b) * area(a) <= 0) continue;
                for (uint32_t j = 0; j < 3; ++j) {
                    if (!(corner(b, j) == corner(a, i))) continue;
                    const bool after = corner(b, j + 2) == corner(a, i + 1),
                               before = corner(b, j + 1) == corner(a, i + 2);
                    if ((after || before) && found.insert({b, j}).second) open.emplace_back(b, j);
                }
            }
        }
        return found;
    }

private:
    const lancer::MeshData& d_;
};

}  // namespace

std::optional<Tangents3> tangents_of(const lancer::MeshData& data, uint32_t triangle)
{
    const Walker walker(data);
    Tangents3 made;
    const auto& named = data.triangles[triangle];
    const auto in_file = [&](uint32_t i) { return !(data.tangents[i].along == lancer::Vec3{}); };
    if (!data.tangents.empty() && std::all_of(named.begin(), named.end(), in_file)) {
        for (size_t k = 0; k < 3; ++k) made.along[k] = vec(data.tangents[named[k]].along);
        made.sign = double{data.tangents[named[0]].sign};
        return made;
    }
    if (walker.area(triangle) == 0) return {};
    made.sign = walker.area(triangle) < 0 ? -1 : 1;
    for (uint32_t k = 0; k < 3; ++k) {
        const Vec n = walker.normal(triangle, k);
        const auto flat = [&](Vec v) { return unit(v - n * dot(n, v)); };
        Vec sum;
        for (const auto& [t, i] : walker.around(triangle, k)) {
            const double c = dot(flat(walker.edge(t, i, i + 1)), flat(walker.edge(t, i, i + 2)));
            sum = sum + flat(walker.along(t)) * std::acos(std::clamp(c, -1.0, 1.0));
        }
        made.along[k] = unit(sum);
    }
    const Vec face = cross(walker.edge(triangle, 0, 1), walker.edge(triangle, 0, 2));
    if (dot(face, walker.normal(triangle, 0)) < 0) made.sign = -made.sign;
    return made;
}

}  // namespace reference
