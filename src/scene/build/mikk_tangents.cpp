#include "scene/build/mikk_tangents.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/disjoint_sets.h"
#include "core/parallel.h"
#include "scene/build/first_index.h"

namespace lancer {
namespace {

constexpr uint32_t nobody = FirstIndex::none;

Vec3d unit_or_zero(Vec3d v)
{
    const double l = length(v);
    return l > 0 && std::isfinite(l) ? v / l : Vec3d{};
}

struct Made {
    std::vector<MeshTangent> values;
    std::vector<CornerTable::Corners> triangles;  // of each triangle, `nobody` where it has no texture coordinates
};

class TangentMaker {
public:
    TangentMaker(const Mesh& mesh, const MeshShading& shading, const std::vector<Vec2>& uvs)
        : mesh_(mesh), shading_(shading), uvs_(uvs), faces_(mesh.triangles.size()), groups_(3 * mesh.triangles.size())
    {
    }

    Made make()
    {
        measure_faces();
        weld();
        join_along_edges();
        add_up();
        return number();
    }

private:
    struct Face {
        Vec3d along{};       // +u, unit; zero if the triangle has no area in the picture
        Vec3d normal{};      // by the order of its corners, unit
        bool keeps = false;  // u and v turn as the corners do
        bool has_uv = false;
    };
    Vec3d position(uint32_t corner) const
    {
        return to_double(mesh_.positions[mesh_.triangles[corner / 3][corner % 3]]);
    }
    Vec2 uv(uint32_t corner) const { return uvs_[(*shading_.uv_triangles.find(corner / 3))[corner % 3]]; }
    Vec3d normal(uint32_t corner) const
    {
        const auto* const named = shading_.normals.find(mesh_, corner / 3);
        return named ? to_double(shading_.normals.value(mesh_, (*named)[corner % 3])) : faces_[corner / 3].normal;
    }
    bool counts(uint32_t face) const { return faces_[face].has_uv && faces_[face].along != Vec3d{}; }

    void measure_faces()
    {
        for_each_face([&](uint32_t f) {
            Face& face = faces_[f];
            const Vec3d a = position(3 * f), e1 = position(3 * f + 1) - a, e2 = position(3 * f + 2) - a;
            face.normal = unit_or_zero(cross(e1, e2));
            face.has_uv = shading_.uv_triangles.find(f) != nullptr;
            if (!face.has_uv) return;
            const Vec2d t(uv(3 * f)), t1(uv(3 * f + 1)), t2(uv(3 * f + 2));
            const double u1 = t1.x - t.x, v1 = t1.y - t.y, u2 = t2.x - t.x, v2 = t2.y - t.y, area = u1 * v2 - u2 * v1;
            face.keeps = area > 0;
            if (area != 0) face.along = unit_or_zero((e1 * v2 - e2 * v1) * (face.keeps ? 1.0 : -1.0));
        });
    }

    // Gives the same number to corners with the same position, normal and texture coordinates.
    void weld()
    {
        const auto corners = static_cast<uint32_t>(3 * faces_.size());
        welded_.assign(corners, nobody);
        FirstIndex known(corners);
        for (uint32_t c = 0; c < corners; ++c) {
            if (!faces_[c / 3].has_uv) continue;
            const Vec3d p = position(c), n = normal(c);
            const Vec2 t = uv(c);
            const uint64_t hash = hash_of_numbers({p.x, p.y, p.z, n.x, n.y, n.z, double{t.x}, double{t.y}});
            welded_[c] =
                known.of(c, hash, [&](uint32_t o) { return position(o) == p && uv(o) == t && normal(o) == n; });
        }
    }

    // The other end of the edge that starts at a corner.
    static uint32_t next_corner(uint32_t c) { return c % 3 == 2 ? c - 2 : c + 1; }
    void join_along_edges()
    {
        const auto corners = static_cast<uint32_t>(welded_.size());
        FirstIndex edges(corners);
        const auto hash = [](uint32_t from, uint32_t to) { return uint64_t{from} << 32 | to; };
        const auto is = [&](uint32_t from, uint32_t to) {
            return [this, from, to](uint32_t e) { return welded_[e] == from && welded_[next_corner(e)] == to; };
        };
        for (uint32_t e = 0; e < corners; ++e) {
            if (!counts(e / 3)) continue;
            const uint32_t from = welded_[e], to = welded_[next_corner(e)];
            edges.of(e, hash(from, to), is(from, to));
        }
        for (uint32_t e = 0; e < corners; ++e) {
            if (!counts(e / 3)) continue;
            const uint32_t from = welded_[e], to = welded_[next_corner(e)];
            const uint32_t other = edges.find(hash(to, from), is(to, from));
            if (other == nobody || faces_[other / 3].keeps != faces_[e / 3].keeps) continue;
            groups_.join(e, next_corner(other));
            groups_.join(next_corner(e), other);
        }
    }

    void add_up()
    {
        sums_.assign(welded_.size(), Vec3d{});
        for (uint32_t c = 0; c < welded_.size(); ++c) {
            if (!counts(c / 3)) continue;
            const Vec3d n = normal(c), p = position(c);
            const auto in_plane = [&](Vec3d v) { return unit_or_zero(v - n * dot(n, v)); };
            const uint32_t second = next_corner(c), third = next_corner(second);
            const double cos = dot(in_plane(position(second) - p), in_plane(position(third) - p));
            sums_[groups_.find(c)] += in_plane(faces_[c / 3].along) * std::acos(std::clamp(cos, -1.0, 1.0));
        }
    }

    // Corners of triangles without an area in the picture take what another corner in the same place has.
    Made number()
    {
        Made made;
        made.triangles.assign(faces_.size(), {nobody, nobody, nobody});
        std::vector<uint32_t> donor(welded_.size(), nobody);  // of what is welded: a corner that counts
        for (uint32_t c = 0; c < welded_.size(); ++c)
            if (counts(c / 3) && donor[welded_[c]] == nobody) donor[welded_[c]] = c;
        std::vector<std::array<uint32_t, 2>> numbers(welded_.size(), {nobody, nobody});  // of each group and sign
        for (uint32_t c = 0; c < welded_.size(); ++c) {
            if (!faces_[c / 3].has_uv) continue;
            const uint32_t giver = counts(c / 3) ? c : donor[welded_[c]];
            const uint32_t group = giver == nobody ? c : groups_.find(giver);
            const Face& face = faces_[(giver == nobody ? c : giver) / 3];
            // The normals of the file say which side is the front, whatever the order of the corners.
            const bool is_positive = face.keeps != (dot(face.normal, normal(c)) < 0);
            uint32_t& number = numbers[group][is_positive ? 1 : 0];
            if (number == nobody) {
                number = static_cast<uint32_t>(made.values.size());
                Vec3d along = unit_or_zero(sums_[group]);
                if (along == Vec3d{}) along = any_across(normal(c));
                made.values.push_back({to_float(along), is_positive ? 1.0f : -1.0f});
            }
            made.triangles[c / 3][c % 3] = number;
        }
        return made;
    }
    static Vec3d any_across(Vec3d n)
    {
        const Vec3d axis = std::abs(n.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
        return unit_or_zero(axis - n * dot(n, axis));
    }

    template <class F>
    void for_each_face(const F& f) const
    {
        constexpr size_t block = 1 << 14;
        parallel_for((faces_.size() + block - 1) / block, [&](size_t b) {
            for (size_t i = b * block; i < std::min(faces_.size(), (b + 1) * block); ++i) f(static_cast<uint32_t>(i));
        });
    }

    const Mesh& mesh_;
    const MeshShading& shading_;
    const std::vector<Vec2>& uvs_;
    std::vector<Face> faces_;
    std::vector<uint32_t> welded_;  // of each corner: the first one like it
    DisjointSets groups_;           // of corners that share a tangent
    std::vector<Vec3d> sums_;       // of each group, at its first corner
};

// Adds those of one set of texture coordinates. wants(triangle): whether it needs them.
template <class Wants>
void add_tangents(const Mesh& mesh, MeshShading& shading, const std::vector<Vec2>& uvs, const Wants& wants)
{
    const Made made = TangentMaker(mesh, shading, uvs).make();
    std::vector<MeshTangent> values = std::move(shading.tangents.values);
    std::vector<CornerTable::Corners> triangles(mesh.triangles.size(), {nobody, nobody, nobody});
    std::vector<uint32_t> place(made.values.size(), nobody);  // of each that is used, in `values`
    for (uint32_t t = 0; t < triangles.size(); ++t) {
        if (const auto* known = shading.tangents.triangles.find(t)) triangles[t] = *known;
        if (!wants(t)) continue;
        for (size_t k = 0; k < 3; ++k) {
            uint32_t& at = place[made.triangles[t][k]];
            if (at == nobody)
                at = static_cast<uint32_t>(values.size()), values.push_back(made.values[made.triangles[t][k]]);
            triangles[t][k] = at;
        }
    }
    values.shrink_to_fit();
    shading.tangents = {std::move(values),
                        CornerTable(triangles, [&](uint32_t t) { return triangles[t][0] != nobody; })};
}

}  // namespace

void add_mikk_tangents(Scene& scene)
{
    const auto reads = [&](uint32_t m) { return scene.traits[m].reads_tangents(); };
    for (size_t i = 0; i < scene.shading.size(); ++i) {
        MeshShading& shading = scene.shading[i];
        const Mesh& mesh = scene.geometry.meshes[i];
        // Corners are counted in 32 bits; a larger mesh keeps the frames of its triangles.
        if (shading.uvs.empty() || !shading.uses(reads) || mesh.triangles.size() > nobody / 3) continue;
        for (const bool second : {false, true}) {
            const auto wants = [&](uint32_t t) {
                const MaterialTraits& traits = scene.traits[shading.material_of(t)];
                return traits.reads_tangents() && shading.uv_triangles.find(t) && !shading.tangents.triangles.find(t) &&
                       (traits.tangents_by_second_uv && !shading.second_uvs.empty()) == second;
            };
            bool any = false;
            for (uint32_t t = 0; t < mesh.triangles.size() && !any; ++t) any = wants(t);
            if (any) add_tangents(mesh, shading, second ? shading.second_uvs : shading.uvs, wants);
        }
    }
}

}  // namespace lancer
