#include "scene/build/mesh_tables.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/octahedral.h"

namespace lancer {
namespace {

using Corners = CornerTable::Corners;

template <class T>
uint64_t bytes_of(const std::vector<T>& v)
{
    return v.size() * sizeof(T);
}

// Which of `values` stay, and under which number: those that some corner names, in the order of the file.
struct Renumbering {
    std::vector<uint32_t> number;  // of each value; empty: all stay as they are
    uint64_t kept = 0;

    Renumbering(const std::vector<Corners>& all, size_t values)
    {
        constexpr uint32_t named = 1;
        number.assign(values, 0);
        for (const Corners& corners : all)
            for (const uint32_t i : corners)
                if (i < values) number[i] = named;  // what is no index says that there is none
        for (uint32_t& n : number)
            if (n == named)
                n = static_cast<uint32_t>(kept++);
            else
                n = UINT32_MAX;
        if (kept == values) number.clear();
    }
    void apply(std::vector<Corners>& all) const
    {
        if (number.empty()) return;
        for (Corners& corners : all)
            for (uint32_t& i : corners)
                if (i < number.size()) i = number[i];
    }
    template <class T, class F>
    auto kept_of(const std::vector<T>& values, const F& change) const
    {
        std::vector<decltype(change(values[0]))> result;
        result.reserve(kept + 1);
        for (size_t i = 0; i < values.size(); ++i)
            if (number.empty() || number[i] != UINT32_MAX) result.push_back(change(values[i]));
        return result;
    }
};

// Which normal each vertex has in all triangles that name it: no_normal in flat ones, also where none names it. Nothing
// where some vertex has several. triangles: as they name the vertices, of which there are so many.
std::vector<uint32_t> normals_of_vertices(const MeshData& data, const std::vector<Corners>& triangles, size_t vertices)
{
    constexpr uint32_t none = MeshData::no_normal;
    const auto are_same = [&](uint32_t a, uint32_t b) {
        return a == b || std::memcmp(&data.normals[a], &data.normals[b], sizeof(Vec3)) == 0;
    };
    std::vector<uint32_t> of(vertices, none);
    for (size_t t = 0; t < triangles.size(); ++t) {
        const Corners& normals = data.normal_triangles[t];
        if (normals[0] == none) continue;
        for (size_t k = 0; k < 3; ++k) {
            uint32_t& n = of[triangles[t][k]];
            if (n == none) n = normals[k];
            if (!are_same(n, normals[k])) return {};
        }
    }
    for (size_t t = 0; t < triangles.size(); ++t)
        if (data.normal_triangles[t][0] == none && of[triangles[t][0]] != none) return {};
    return of;
}

// of(i): the normal of vertex i, to stand behind its position.
template <class Of>
void put_normals_behind(Mesh& mesh, const Of& of)
{
    std::vector<Vec3> both;
    both.reserve(2 * mesh.vertices() + 1);
    for (size_t i = 0; i < mesh.vertices(); ++i) both.push_back(mesh.vertex(i)), both.push_back(of(i));
    both.emplace_back();
    mesh.positions = std::move(both), mesh.rows = 2;
    for (auto& t : mesh.triangles)
        for (uint32_t& corner : t) corner *= 2;
}

// back: inverse of the mesh's place. mesh: filled.
void fill_normals(const MeshData& data, const Transform& back, Mesh& mesh, MeshShading& shading,
                  UnusedFeatures& unused_features)
{
    const Renumbering numbers(data.normal_triangles, data.normals.size());
    const uint64_t unused = data.normals.size() - numbers.kept;
    unused_features.add("unused vertex normals", unused,
                        unused * sizeof(Vec3) + (numbers.kept ? 0 : bytes_of(data.normal_triangles)));
    if (numbers.kept == 0) return;
    const auto moved = [&](const Vec3& n) { return to_float(normalize(back.normal_by_inverse(to_double(n)))); };
    const size_t vertices = mesh.vertices(), faces = mesh.triangles.size();
    CornerNormals& normals = shading.normals;
    std::vector<uint32_t> of_vertices;
    if (vertices < UINT32_MAX / 2 && vertices * sizeof(Vec3) <= numbers.kept * sizeof(Vec3) + faces * sizeof(Corners))
        of_vertices = normals_of_vertices(data, mesh.triangles, vertices);
    if (of_vertices.empty()) {
        normals.values = numbers.kept_of(data.normals, moved), normals.triangles = data.normal_triangles;
        normals.storage = CornerNormals::Storage::corners;
        numbers.apply(normals.triangles);
        normals.values.emplace_back();
    } else {
        put_normals_behind(mesh, [&](size_t i) {
            const uint32_t n = of_vertices[i];
            return n == MeshData::no_normal ? CornerNormals::of_flat() : moved(data.normals[n]);
        });
        normals.storage = CornerNormals::Storage::vertices;
        unused_features.add("redundant vertex normal indices", faces, faces * sizeof(Corners));
    }
}

// Of a finite vector; of another one, which marks a flat vertex, none.
uint32_t code_of_normal(const Vec3& n) { return is_finite(n) ? to_octahedral(n) : no_octahedral; }

// Those that the file gives, of the triangles whose material reads them. shading: with materials.
void fill_tangents(const MeshData& data, const Transform& place, const std::vector<MaterialTraits>& traits,
                   MeshShading& shading)
{
    if (data.tangents.empty()) return;
    CornerTangents& tangents = shading.tangents;
    tangents.triangles = CornerTable(data.triangles, [&](uint32_t t) {
        const Corners& named = data.triangles[t];
        return traits[shading.material_of(t)].reads_tangents() && data.uv_triangles[t][0] != MeshData::no_uv &&
               std::none_of(named.begin(), named.end(), [&](uint32_t i) { return data.tangents[i].along == Vec3{}; });
    });
    const Renumbering numbers(tangents.triangles.all(), data.tangents.size());
    if (numbers.kept == 0) return;
    numbers.apply(tangents.triangles.all());
    const float turn = place.determinant() < 0 ? -1.0f : 1.0f;
    tangents.values = numbers.kept_of(data.tangents, [&](const MeshTangent& t) {
        return MeshTangent{to_float(normalize(place.vector(to_double(t.along)))), t.sign * turn};
    });
}

constexpr const char* no_uvs = "triangles with unused texture coordinates";

}  // namespace

void set_materials(MeshShading& shading, std::span<const uint32_t> of_faces)
{
    const bool is_one = std::all_of(of_faces.begin(), of_faces.end(), [&](uint32_t m) { return m == of_faces[0]; });
    if (is_one && !of_faces.empty()) shading.material = of_faces[0];
    shading.face_material = is_one ? CompactIndexArray() : CompactIndexArray(of_faces);
}

void fill_tables(const MeshData& data, const Transform& place, const std::vector<Color>& colors,
                 const std::vector<float>& alphas, const std::vector<MaterialTraits>& traits, Mesh& mesh,
                 MeshShading& shading, UnusedFeatures& unused_features)
{
    const auto same = [](const auto& x) { return x; };
    mesh.triangles = data.triangles;
    const Renumbering positions(data.triangles, data.positions.size());
    positions.apply(mesh.triangles);
    mesh.positions = positions.kept_of(data.positions, [&](const Vec3d& p) { return to_float(place.point(p)); });
    mesh.positions.emplace_back();
    shading.colors = positions.kept_of(colors, same);
    if (!alphas.empty()) shading.alphas = positions.kept_of(alphas, same);
    const uint64_t unused = data.positions.size() - positions.kept;
    unused_features.add("unused vertices", unused, unused * (sizeof(Vec3) + (colors.empty() ? 0 : sizeof(Color))));

    fill_normals(data, inverse(place), mesh, shading, unused_features);
    if (data.uvs.empty()) return;
    shading.uv_triangles = CornerTable(data.uv_triangles, [&](uint32_t t) {
        return data.uv_triangles[t][0] != MeshData::no_uv && traits[shading.material_of(t)].reads_uv;
    });
    const Renumbering uvs(shading.uv_triangles.all(), data.uvs.size());
    uvs.apply(shading.uv_triangles.all());
    shading.uvs = uvs.kept_of(data.uvs, same);
    if (!data.second_uvs.empty() && shading.uses([&](uint32_t m) { return traits[m].reads_second_uv; }))
        shading.second_uvs = uvs.kept_of(data.second_uvs, same);
    fill_tangents(data, place, traits, shading);
    unused_features.add(no_uvs, data.triangles.size() - shading.uv_triangles.all().size(),
                        bytes_of(data.uvs) + bytes_of(data.uv_triangles) - bytes_of(shading.uvs) -
                            std::min(shading.uv_triangles.bytes(), bytes_of(data.uv_triangles)));
}

void pack_normals(Mesh& mesh, CornerNormals& normals)
{
    if (normals.storage == CornerNormals::Storage::corners) {
        normals.codes.resize(normals.values.size() - 1);
        std::transform(normals.values.begin(), normals.values.end() - 1, normals.codes.begin(), code_of_normal);
        normals.values = std::vector<Vec3>();  // {} would keep its memory
        normals.storage = CornerNormals::Storage::corner_codes;
    } else if (normals.storage == CornerNormals::Storage::vertices) {
        std::vector<Vec3> positions(mesh.vertices() + 1);
        normals.codes.resize(mesh.vertices());
        for (size_t i = 0; i < mesh.vertices(); ++i) {
            positions[i] = mesh.vertex(i);
            normals.codes[i] = code_of_normal(mesh.positions[mesh.rows * i + 1]);
        }
        for (auto& t : mesh.triangles)
            for (uint32_t& corner : t) corner /= mesh.rows;
        mesh.positions = std::move(positions), mesh.rows = 1;
        normals.storage = CornerNormals::Storage::vertex_codes;
    }
}

void drop_unread_uvs(Scene& scene)
{
    for (MeshShading& s : scene.shading) {
        if (s.uvs.empty() || s.uses([&](uint32_t m) { return scene.traits[m].reads_uv; })) continue;
        scene.unused_features.add(no_uvs, s.uv_triangles.all().size(), bytes_of(s.uvs) + s.uv_triangles.bytes());
        s.uvs = std::vector<Vec2>(), s.second_uvs = std::vector<Vec2>();  // {} would keep their memory
        s.uv_triangles = {};
    }
}

}  // namespace lancer
