#include "scene/build/displace.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"
#include "scene/build/first_index.h"

namespace lancer {
namespace {

class Displacer {
public:
    Displacer(MeshData& mesh, std::span<const Displacement> of_materials)
        : m_(mesh), of_materials_(of_materials), corners_(3 * mesh.triangles.size())
    {
    }

    void run()
    {
        weld();
        find_sides();
        move();
        renew_normals();
    }

private:
    const Displacement& displacement_of(size_t triangle) const
    {
        return of_materials_[of_materials_.size() == 1 || m_.face_material.empty() ? 0 : m_.face_material[triangle]];
    }
    Vec3d place(size_t corner) const { return m_.positions[m_.triangles[corner / 3][corner % 3]]; }
    const Vec3& normal(size_t corner) const { return m_.normals[m_.normal_triangles[corner / 3][corner % 3]]; }
    static size_t next(size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
    double angle(size_t corner) const
    {
        return corner_angle(place(corner), place(next(corner)), place(next(next(corner))));
    }

    // Of each position the first one in the same place.
    void weld()
    {
        const auto count = static_cast<uint32_t>(m_.positions.size());
        FirstIndex known(count);
        first_.resize(count);
        for (uint32_t i = 0; i < count; ++i) {
            const Vec3d p = m_.positions[i];
            first_[i] = known.of(i, hash_of_numbers({p.x, p.y, p.z}), [&](uint32_t o) { return m_.positions[o] == p; });
        }
    }
    uint32_t first_of(size_t corner) const { return first_[m_.triangles[corner / 3][corner % 3]]; }

    // Of each triangle whether its corners turn the other way than its normals say, which decide what the front is.
    void find_sides()
    {
        is_turned_.resize(corners_ / 3);
        for_each_corner([&](size_t c) {
            if (c % 3 != 0) return;
            const Vec3d a = place(c), n = cross(place(c + 1) - a, place(c + 2) - a);
            is_turned_[c / 3] = dot(n, to_double(normal(c))) < 0 ? 1 : 0;
        });
    }

    // How far a corner would move by its own map, which is filtered over the size of its triangle.
    float way_of(size_t corner) const
    {
        const Displacement& d = displacement_of(corner / 3);
        const auto& named = m_.uv_triangles.empty() ? no_uvs : m_.uv_triangles[corner / 3];
        if (!d.heights || named[0] == MeshData::no_uv) return 0;
        const std::vector<Vec2>& uvs = d.heights->use().by_second_uv && !m_.second_uvs.empty() ? m_.second_uvs : m_.uvs;
        const Vec2 at = uvs[named[corner % 3]], a = uvs[named[1]] - uvs[named[0]], b = uvs[named[2]] - uvs[named[0]];
        const float width = std::sqrt(0.5f * std::abs(a.x * b.y - a.y * b.x));
        return (d.heights->eval(at, Footprint(width)).r - d.midlevel) * d.scale;
    }

    void move()
    {
        struct Sum {
            Vec3d way;
            double weight = 0;
        };
        std::vector<float> ways(corners_), angles(corners_);
        for_each_corner([&](size_t c) { ways[c] = way_of(c), angles[c] = static_cast<float>(angle(c)); });
        std::vector<Sum> sums(m_.positions.size());
        for (size_t c = 0; c < corners_; ++c) {
            Sum& sum = sums[first_of(c)];
            sum.way += to_double(normal(c)) * (double{ways[c]} * double{angles[c]});
            sum.weight += double{angles[c]};
        }
        for (size_t i = 0; i < sums.size(); ++i)
            if (const Sum& sum = sums[first_[i]]; sum.weight > 0) m_.positions[i] += sum.way / sum.weight;
    }

    // Corners are one if they were in one place with one normal.
    void renew_normals()
    {
        const auto count = static_cast<uint32_t>(corners_);
        FirstIndex known(count);
        std::vector<uint32_t> group(count), number(count, FirstIndex::none);
        std::vector<uint8_t> moves(count);  // of each group: whether some triangle of it has a map
        for (uint32_t c = 0; c < count; ++c) {
            const Vec3 n = normal(c);
            const double where = first_of(c);
            group[c] = known.of(c, hash_of_numbers({where, double{n.x}, double{n.y}, double{n.z}}),
                                [&](uint32_t o) { return first_of(o) == first_of(c) && normal(o) == n; });
            if (displacement_of(c / 3).heights) moves[group[c]] = 1;
        }
        std::vector<Vec3d> sums(count);
        std::vector<Vec3> ways(count);  // of each corner: the normal of its triangle by its angle
        for_each_corner([&](size_t c) {
            const Vec3d a = place(c), n = cross(place(next(c)) - a, place(next(next(c))) - a);
            const double l = length(n);
            if (l > 0) ways[c] = to_float(n * (angle(c) / (is_turned_[c / 3] ? -l : l)));
        });
        for (uint32_t c = 0; c < count; ++c) sums[group[c]] += to_double(ways[c]);
        std::vector<Vec3> normals;
        for (uint32_t c = 0; c < count; ++c) {
            const uint32_t g = group[c];
            if (number[g] == FirstIndex::none) {
                number[g] = static_cast<uint32_t>(normals.size());
                const double l = length(sums[g]);
                normals.push_back(moves[g] && l > 0 ? to_float(sums[g] / l) : normal(g));
            }
            group[c] = number[g];
        }
        for (size_t c = 0; c < corners_; ++c) m_.normal_triangles[c / 3][c % 3] = group[c];
        m_.normals = std::move(normals);
    }

    template <class F>
    void for_each_corner(const F& f) const
    {
        constexpr size_t block = 1 << 14;
        parallel_for((corners_ + block - 1) / block, [&](size_t b) {
            for (size_t c = b * block; c < std::min(corners_, (b + 1) * block); ++c) f(c);
        });
    }

    static constexpr std::array<uint32_t, 3> no_uvs{MeshData::no_uv, MeshData::no_uv, MeshData::no_uv};
    MeshData& m_;
    std::span<const Displacement> of_materials_;
    size_t corners_;
    std::vector<uint32_t> first_;
    std::vector<uint8_t> is_turned_;
};

}  // namespace

void displace(MeshData& mesh, std::span<const Displacement> of_materials) { Displacer(mesh, of_materials).run(); }

}  // namespace lancer
