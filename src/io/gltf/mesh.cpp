#include "io/gltf/mesh.h"

#include <atomic>
#include <span>

#include "io/mesh_values.h"
#include "io/obj/smooth.h"
#include "io/obj/triangulate.h"

namespace lancer {
namespace {

constexpr std::array<uint32_t, 3> left_out{UINT32_MAX, UINT32_MAX, UINT32_MAX};

// The corners of triangle t, in the order of the front side.
std::array<size_t, 3> corners_of(GltfPrimitive::Mode mode, size_t t)
{
    if (mode == GltfPrimitive::Mode::triangles) return {3 * t, 3 * t + 1, 3 * t + 2};
    if (mode == GltfPrimitive::Mode::strip) return {t, t + 1 + t % 2, t + 2 - t % 2};
    return {t + 1, t + 2, 0};
}

}  // namespace

void GltfMeshBuilder::reserve(size_t vertices, size_t triangles)
{
    if (vertices > UINT32_MAX - 1 || triangles > UINT32_MAX - 1)
        doc_.fail(doc_.root(), "more than 4294967294 vertices or triangles, those of all nodes together");
    mesh_.positions.reserve(vertices);
    mesh_.triangles.reserve(triangles);
}

void GltfMeshBuilder::add(const std::vector<GltfPrimitive>& primitives, const Transform& to_world)
{
    std::map<std::array<size_t, 7>, Vertices> known;
    for (const GltfPrimitive& p : primitives) {
        const auto [entry, is_new] = known.try_emplace(p.key);
        if (is_new) entry->second = add_vertices(p, to_world);
        add_triangles(p, entry->second, to_world.determinant() < 0);
    }
}

GltfMeshBuilder::Vertices GltfMeshBuilder::add_vertices(const GltfPrimitive& p, const Transform& to_world)
{
    const size_t first = mesh_.positions.size(), end = first + p.positions.count;
    mesh_.positions.resize(end);
    add_positions(p, to_world, first);
    if (p.normals) {
        const Transform back = inverse(to_world);
        mesh_.normals.resize(end);
        std::atomic<size_t> unfit = 0;
        for_each_element<3>(*p.normals, [&](size_t i, const std::array<double, 3>& v) {
            const Vec3d n = back.normal_by_inverse({v[0], v[1], v[2]});
            const Vec3 unit = is_finite(n) ? unit_normal(n) : Vec3{};
            mesh_.normals[first + i] = unit;
            if (unit == Vec3{}) ++unfit;
        });
        if (unfit)
            doc_.warn(*p.normals->json,
                      "normal of zero length or not of three finite numbers; faces that use it are flat", unfit);
    }
    if (p.uvs) add_uvs(p, first);
    if (p.tangents) add_tangents(p, to_world, first);
    if (p.colors) add_colors(p, first);
    return {first, p.normals.has_value(), p.uvs.has_value()};
}

void GltfMeshBuilder::add_positions(const GltfPrimitive& p, const Transform& to_world, size_t first)
{
    std::atomic<size_t> unfit = SIZE_MAX;
    for_each_element<3>(p.positions, [&](size_t i, const std::array<double, 3>& v) {
        mesh_.positions[first + i] = to_world.point({v[0], v[1], v[2]});
        if (!is_finite(mesh_.positions[first + i])) unfit = i;
    });
    if (unfit != SIZE_MAX)
        doc_.fail(*p.positions.json, "a coordinate of vertex " + std::to_string(unfit) + " is not a finite number");
}

void GltfMeshBuilder::add_uvs(const GltfPrimitive& p, size_t first)
{
    const size_t end = first + p.positions.count;
    const auto read = [&](const GltfAccessor& from, const std::optional<GltfUvTransform>& moved,
                          std::vector<Vec2>& uvs) {
        uvs.resize(end);
        std::atomic<size_t> broken = 0;
        for_each_element<2>(from, [&](size_t i, const std::array<double, 2>& v) {
            const Vec2d up{v[0], 1 - v[1]}, at = moved ? moved->apply(up) : up;
            uvs[first + i] = uv_of(at.x, at.y);
            if (is_broken(uvs[first + i])) ++broken;
        });
        if (broken)
            doc_.warn(*from.json, "texture coordinates are not finite numbers; faces that use them get none", broken);
    };
    read(*p.uvs, p.material->uv_transforms[0], mesh_.uvs);
    if (p.second_uvs) {
        // Of primitives without a second set the first takes its place.
        for (size_t i = mesh_.second_uvs.size(); i < first; ++i) mesh_.second_uvs.push_back(mesh_.uvs[i]);
        read(*p.second_uvs, p.material->uv_transforms[1], mesh_.second_uvs);
    } else if (!mesh_.second_uvs.empty()) {
        mesh_.second_uvs.resize(first);
        mesh_.second_uvs.insert(mesh_.second_uvs.end(), mesh_.uvs.begin() + static_cast<std::ptrdiff_t>(first),
                                mesh_.uvs.end());
    }
}

// Vectors go along with the surface, and where a map mirrors the bitangent is on the other side of both.
void GltfMeshBuilder::add_tangents(const GltfPrimitive& p, const Transform& to_world, size_t first)
{
    mesh_.tangents.resize(first + p.positions.count);
    const float turn = to_world.determinant() < 0 ? -1.0f : 1.0f;
    std::atomic<size_t> unfit = 0;
    for_each_element<4>(*p.tangents, [&](size_t i, const std::array<double, 4>& v) {
        const Vec3d along = to_world.vector({v[0], v[1], v[2]});
        MeshTangent& t = mesh_.tangents[first + i];
        t = {is_finite(along) ? unit_normal(along) : Vec3{}, v[3] < 0 ? -turn : turn};
        if (t.along == Vec3{}) ++unfit;
    });
    if (unfit)
        doc_.warn(*p.tangents->json, "tangent of zero length or not of finite numbers; computed where it is used",
                  unfit);
}

void GltfMeshBuilder::add_colors(const GltfPrimitive& p, size_t first)
{
    mesh_.colors.resize(first, Color{1, 1, 1});  // of primitives without any
    mesh_.colors.resize(first + p.positions.count);
    std::atomic<size_t> outside = 0, transparent = 0;
    const bool fades = p.colors->components == 4 && p.material->fades;
    if (fades) {
        mesh_.alphas.resize(first, 1);
        mesh_.alphas.resize(first + p.positions.count, 1);
    }
    const auto part = [](double x) { return x > 0 ? static_cast<float>(std::min(x, 1.0)) : 0; };
    const auto store = [&](size_t i, double r, double g, double b, double alpha) {
        mesh_.colors[first + i] = {part(r), part(g), part(b)};
        if (!(std::min({r, g, b}) >= 0 && std::max({r, g, b}) <= 1)) ++outside;
        if (fades) mesh_.alphas[first + i] = part(alpha);
        if (alpha != 1) ++transparent;
    };
    if (p.colors->components == 4)
        for_each_element<4>(*p.colors, [&](size_t i, const auto& v) { store(i, v[0], v[1], v[2], v[3]); });
    else
        for_each_element<3>(*p.colors, [&](size_t i, const auto& v) { store(i, v[0], v[1], v[2], 1); });
    if (outside) doc_.warn(*p.colors->json, "vertex colour outside of its range cut off", outside);
    if (transparent && p.material->masks)
        doc_.warn(*p.colors->json, "the alpha of vertex colours is not used with alphaMode MASK", transparent);
}

void GltfMeshBuilder::add_triangles(const GltfPrimitive& p, const Vertices& vertices, bool turns)
{
    const size_t first = mesh_.triangles.size(), count = p.triangles();
    mesh_.triangles.resize(first + count);
    std::atomic<size_t> flat = 0, beyond = SIZE_MAX;
    const auto fill = [&](const auto& index) {
        for_each_index(count, [&](size_t t) {
            std::array<uint32_t, 3> triangle{};
            const std::array<size_t, 3> corners = corners_of(p.mode, t);
            for (size_t k = 0; k < 3; ++k) {
                const size_t i = index(corners[k]);
                if (i >= p.positions.count) beyond = corners[k];
                triangle[k] = static_cast<uint32_t>(vertices.first + std::min(i, p.positions.count - 1));
            }
            if (turns) std::swap(triangle[1], triangle[2]);
            const bool counts =
                has_area(mesh_.positions[triangle[0]], mesh_.positions[triangle[1]], mesh_.positions[triangle[2]]);
            mesh_.triangles[first + t] = counts ? triangle : left_out;
            if (!counts) ++flat;
        });
    };
    if (p.indices)
        GltfIndices(*p.indices, doc_).read(fill);
    else
        fill([](size_t i) { return i; });
    if (beyond != SIZE_MAX)
        doc_.fail(*p.json, "index " + std::to_string(beyond) + " is beyond the " + std::to_string(p.positions.count) +
                               " vertices");
    if (flat) {
        const auto begin = mesh_.triangles.begin() + static_cast<std::ptrdiff_t>(first);
        mesh_.triangles.erase(std::remove(begin, mesh_.triangles.end(), left_out), mesh_.triangles.end());
        // Strips have some on purpose, to turn a corner.
        if (p.mode != GltfPrimitive::Mode::strip) doc_.warn(*p.json, "zero-area face dropped", flat);
    }
    if (mesh_.triangles.size() > first)
        ranges_.push_back({first, mesh_.triangles.size() - first, vertices, slot_of(p)});
}

// Materials enter the mesh when the first triangle needs them.
uint32_t GltfMeshBuilder::slot_of(const GltfPrimitive& p)
{
    const auto [entry, is_new] = slots_.try_emplace(p.material_number, static_cast<uint32_t>(mesh_.materials.size()));
    if (is_new) mesh_.materials.push_back(p.material->description);
    return entry->second;
}

// Each corner has the normal of its vertex; a face has none if a corner has none.
void GltfMeshBuilder::finish_normals()
{
    if (mesh_.normals.empty()) return;
    mesh_.normals.resize(mesh_.positions.size());
    mesh_.normal_triangles.resize(mesh_.triangles.size());
    for (const Range& range : ranges_)
        for_each_index(range.count, [&](size_t i) {
            const std::array<uint32_t, 3>& t = mesh_.triangles[range.first + i];
            std::array<uint32_t, 3>& own = mesh_.normal_triangles[range.first + i];
            const bool usable = range.vertices.has_normals && std::none_of(t.begin(), t.end(), [&](uint32_t v) {
                                    return mesh_.normals[v] == Vec3{};
                                });
            own = t;
            if (!usable) own.fill(MeshData::no_normal);
        });
    std::replace(mesh_.normals.begin(), mesh_.normals.end(), Vec3{}, Vec3{0, 0, 1});
}

// Likewise.
void GltfMeshBuilder::finish_uvs()
{
    if (mesh_.uvs.empty()) return;
    mesh_.uvs.resize(mesh_.positions.size());
    mesh_.uv_triangles.resize(mesh_.triangles.size());
    for (const Range& range : ranges_)
        for_each_index(range.count, [&](size_t i) {
            const std::array<uint32_t, 3>& t = mesh_.triangles[range.first + i];
            std::array<uint32_t, 3>& own = mesh_.uv_triangles[range.first + i];
            const bool usable = range.vertices.has_uvs &&
                                std::none_of(t.begin(), t.end(), [&](uint32_t v) { return is_broken(mesh_.uvs[v]); });
            own = t;
            if (!usable) own.fill(MeshData::no_uv);
        });
    std::replace_if(mesh_.uvs.begin(), mesh_.uvs.end(), is_broken, Vec2{});
    if (mesh_.second_uvs.empty()) return;
    for (size_t i = mesh_.second_uvs.size(); i < mesh_.uvs.size(); ++i) mesh_.second_uvs.push_back(mesh_.uvs[i]);
    std::replace_if(mesh_.second_uvs.begin(), mesh_.second_uvs.end(), is_broken, Vec2{});
}

void GltfMeshBuilder::finish(const Smoothing& smoothing)
{
    finish_normals();
    finish_uvs();
    if (!mesh_.colors.empty()) mesh_.colors.resize(mesh_.positions.size(), Color{1, 1, 1});
    if (std::all_of(mesh_.alphas.begin(), mesh_.alphas.end(), [](float alpha) { return alpha == 1; }))
        mesh_.alphas = {};
    else
        mesh_.alphas.resize(mesh_.positions.size(), 1);
    if (!mesh_.tangents.empty()) mesh_.tangents.resize(mesh_.positions.size());
    if (mesh_.materials.size() > 1) {
        mesh_.face_material.resize(mesh_.triangles.size());
        for (const Range& range : ranges_)
            std::fill_n(mesh_.face_material.begin() + static_cast<std::ptrdiff_t>(range.first), range.count,
                        range.material);
    }
    if (mesh_.normals.empty() && !mesh_.triangles.empty() && smoothing.faces == Smoothing::Faces::all)
        smooth(mesh_, std::vector<uint32_t>(mesh_.triangles.size(), 1), smoothing.largest_deg);
}

}  // namespace lancer
