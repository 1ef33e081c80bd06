#include "io/subdivide/catmull_clark.h"

#include <memory>
#include <utility>

#include "io/module_file.h"
#include "io/obj/smooth.h"
#include "io/subdivide/module.h"
#include "scene/build/first_index.h"

namespace lancer {
namespace {

struct SubdivideModule {
    decltype(&lancer_subdivide_refine) refine;
    decltype(&lancer_subdivide_copy) copy;
    decltype(&lancer_subdivide_close) close;
};

SubdivideModule load_subdivide_module()
{
    void* const library =
        open_module("lancer_subdivide", lancer_subdivide_current_version,
                    "which subdivides by Catmull and Clark, is missing; build the target lancer_subdivide (it needs "
                    "libosd-dev) or leave out 'catmull_clark'");
    SubdivideModule m = {};
    find_symbol(library, "lancer_subdivide_refine", m.refine);
    find_symbol(library, "lancer_subdivide_copy", m.copy);
    find_symbol(library, "lancer_subdivide_close", m.close);
    return m;
}

const SubdivideModule& subdivide_module()
{
    static const SubdivideModule loaded = load_subdivide_module();  // a failure is tried again next time
    return loaded;
}

// The faces of a mesh as the module wants them.
struct Cage {
    std::vector<int32_t> sizes, corners, uv_corners;
    std::vector<double> positions;
    std::vector<float> vertex_values, uv_values;
    std::vector<uint32_t> triangles;  // the first one of each face

    explicit Cage(const MeshData& m)
    {
        add_vertices(m);
        for (uint32_t t = 0; t < m.triangles.size(); ++t) {
            const bool is_quad = t + 1 < m.triangles.size() && are_a_quad(m, t);
            triangles.push_back(t);
            sizes.push_back(is_quad ? 4 : 3);
            add_corners(m, m.triangles[t], m.uvs.empty() ? none : m.uv_triangles[t], is_quad, t);
            if (is_quad) ++t;
        }
    }

private:
    static constexpr std::array<uint32_t, 3> none{MeshData::no_uv, MeshData::no_uv, MeshData::no_uv};

    void add_vertices(const MeshData& m)
    {
        const auto count = static_cast<uint32_t>(m.positions.size());
        FirstIndex known(count);
        for (uint32_t i = 0; i < count; ++i) {
            const Vec3d p = m.positions[i];
            const uint32_t first =
                known.of(i, hash_of_numbers({p.x, p.y, p.z}), [&](uint32_t o) { return m.positions[o] == p; });
            if (first != i) {
                vertex_.push_back(vertex_[first]);
                continue;
            }
            vertex_.push_back(static_cast<int32_t>(positions.size() / 3));
            positions.insert(positions.end(), {p.x, p.y, p.z});
            const Color c = m.colors.empty() ? Color{1, 1, 1} : m.colors[i];
            vertex_values.insert(vertex_values.end(), {c.r, c.g, c.b, m.alphas.empty() ? 1.0f : m.alphas[i]});
        }
        for (size_t i = 0; i < m.uvs.size(); ++i) {
            const Vec2 a = m.uvs[i], b = m.second_uvs.empty() ? Vec2{} : m.second_uvs[i];
            uv_values.insert(uv_values.end(), {a.x, a.y, b.x, b.y});
        }
        // Faces without texture coordinates share a pair of their own.
        if (!m.uvs.empty()) uv_values.insert(uv_values.end(), {0, 0, 0, 0});
    }
    static bool are_a_quad(const MeshData& m, uint32_t t)
    {
        const auto fits = [](const auto& a, const auto& b) { return a[0] == b[0] && a[2] == b[1]; };
        if (!m.face_material.empty() && m.face_material[t] != m.face_material[t + 1]) return false;
        return fits(m.triangles[t], m.triangles[t + 1]) &&
               (m.uvs.empty() || fits(m.uv_triangles[t], m.uv_triangles[t + 1]));
    }
    void add_corners(const MeshData& m, const std::array<uint32_t, 3>& own, const std::array<uint32_t, 3>& uv,
                     bool is_quad, uint32_t t)
    {
        const auto add = [&](uint32_t vertex, uint32_t named) {
            corners.push_back(vertex_[vertex]);
            if (!m.uvs.empty())
                uv_corners.push_back(static_cast<int32_t>(named == MeshData::no_uv ? m.uvs.size() : named));
        };
        for (size_t k = 0; k < 3; ++k) add(own[k], uv[k]);
        if (is_quad) add(m.triangles[t + 1][2], m.uvs.empty() ? MeshData::no_uv : m.uv_triangles[t + 1][2]);
    }
    std::vector<int32_t> vertex_;  // of each position
};

}  // namespace

MeshData catmull_clark(const MeshData& m, uint32_t levels, const Location& where)
{
    const SubdivideModule& module = subdivide_module();
    const Cage cage(m);
    constexpr double most_faces = 1 << 28;
    if (static_cast<double>(cage.corners.size()) * static_cast<double>(uint64_t{1} << 2 * (levels - 1)) > most_faces)
        throw Error(ErrorKind::no_memory, where, "'catmull_clark' would make more than 268435456 faces");
    const LancerCage in{.vertices = static_cast<uint32_t>(cage.positions.size() / 3),
                        .faces = static_cast<uint32_t>(cage.sizes.size()),
                        .uvs = static_cast<uint32_t>(cage.uv_values.size() / lancer_subdivide_uv_numbers),
                        .levels = levels,
                        .face_sizes = cage.sizes.data(),
                        .corners = cage.corners.data(),
                        .uv_corners = cage.uv_corners.empty() ? nullptr : cage.uv_corners.data(),
                        .positions = cage.positions.data(),
                        .vertex_values = cage.vertex_values.data(),
                        .uv_values = cage.uv_values.data()};
    LancerSubdividedInfo info{};
    const std::unique_ptr<LancerSubdivided, decltype(module.close)> made(module.refine(&in, &info), module.close);
    if (!made) throw Error(ErrorKind::failed, where, std::string("this mesh cannot be subdivided: ") + info.message);
    std::vector<double> positions(size_t{info.vertices} * 3);
    std::vector<float> values(size_t{info.vertices} * lancer_subdivide_vertex_numbers);
    std::vector<float> uvs(size_t{info.uvs} * lancer_subdivide_uv_numbers);
    std::vector<uint32_t> corners(size_t{info.faces} * 4), uv_corners(info.uvs ? corners.size() : 0),
        parents(info.faces);
    module.copy(made.get(), positions.data(), values.data(), uvs.empty() ? nullptr : uvs.data(), corners.data(),
                uv_corners.empty() ? nullptr : uv_corners.data(), parents.data());

    MeshData out;
    out.file = m.file, out.shape = m.shape, out.material_files = m.material_files;
    out.materials = m.materials, out.content_hash = m.content_hash;
    for (size_t i = 0; i < info.vertices; ++i) {
        out.positions.push_back({positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]});
        const float* const v = &values[lancer_subdivide_vertex_numbers * i];
        if (!m.colors.empty()) out.colors.push_back({v[0], v[1], v[2]});
        if (!m.alphas.empty()) out.alphas.push_back(v[3]);
    }
    for (size_t i = 0; i < info.uvs; ++i) {
        const float* const v = &uvs[lancer_subdivide_uv_numbers * i];
        out.uvs.push_back({v[0], v[1]});
        if (!m.second_uvs.empty()) out.second_uvs.push_back({v[2], v[3]});
    }
    for (size_t f = 0; f < info.faces; ++f) {
        const uint32_t parent = cage.triangles[parents[f]];
        const bool has_uv = !m.uvs.empty() && m.uv_triangles[parent][0] != MeshData::no_uv;
        for (const auto& k : {std::array<size_t, 3>{0, 1, 2}, std::array<size_t, 3>{0, 2, 3}}) {
            const auto named = [&](const std::vector<uint32_t>& list) {
                return std::array{list[4 * f + k[0]], list[4 * f + k[1]], list[4 * f + k[2]]};
            };
            out.triangles.push_back(named(corners));
            if (!m.uvs.empty())
                out.uv_triangles.push_back(has_uv ? named(uv_corners)
                                                  : std::array{MeshData::no_uv, MeshData::no_uv, MeshData::no_uv});
            if (!m.face_material.empty()) out.face_material.push_back(m.face_material[parent]);
        }
    }
    constexpr double all_edges = 180;
    smooth(out, std::vector<uint32_t>(out.triangles.size(), 1), all_edges);
    return out;
}

}  // namespace lancer
