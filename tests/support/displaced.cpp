#include "support/displaced.h"

#include "scene/build/divide.h"

namespace lancer {

MeshData seamed_cube(const MaterialDescription& material)
{
    MeshData data;
    data.materials = {material};
    const std::array<std::array<Vec3d, 3>, 6> sides{{{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}},
                                                     {Vec3d{-1, 0, 0}, Vec3d{0, 0, 1}, Vec3d{0, 1, 0}},
                                                     {Vec3d{0, 1, 0}, Vec3d{0, 0, 1}, Vec3d{1, 0, 0}},
                                                     {Vec3d{0, -1, 0}, Vec3d{1, 0, 0}, Vec3d{0, 0, 1}},
                                                     {Vec3d{0, 0, 1}, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}},
                                                     {Vec3d{0, 0, -1}, Vec3d{0, 1, 0}, Vec3d{1, 0, 0}}}};
    for (const auto& [n, x, y] : sides) {
        const auto first = static_cast<uint32_t>(data.positions.size());
        for (const auto& [a, b] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
            data.positions.push_back(n + x * a + y * b);
            data.normals.push_back(to_float(n));
            data.uvs.push_back({0.5f + 0.4f * static_cast<float>(a), 0.5f + 0.3f * static_cast<float>(b)});
        }
        data.triangles.push_back({first, first + 1, first + 2});
        data.triangles.push_back({first, first + 2, first + 3});
    }
    data.uv_triangles = data.normal_triangles = data.triangles;
    return data;
}

MeshData displaceable_ball(uint32_t rounds, const MaterialDescription& material)
{
    DividedMesh made = divide(
        seamed_cube(material), rounds, [](Vec3d, Vec3d, uint32_t) { return true; }, [](uint64_t) {});
    MeshData& data = made.data;
    data.normals.clear();
    for (Vec3d& p : data.positions) p = normalize(p), data.normals.push_back(to_float(p));
    data.normal_triangles = data.triangles;
    return data;
}

MaterialDescription displaced_by(const std::string& picture, float scale)
{
    MaterialDescription m = make_lambert("m", {0.8f, 0.8f, 0.8f});
    m.displacement_map = heights_of(picture);
    m.displacement_scale = scale;
    return m;
}

SceneDescription displaced_scene(MeshData data, const MaterialDescription& material, SubdivisionDescription how)
{
    SceneDescription d;
    data.materials = {make_lambert("file", {0.8f, 0.8f, 0.8f})};
    d.materials.push_back(material);
    MeshDescription mesh = make_mesh(std::make_shared<const MeshData>(std::move(data)));
    mesh.material = material.name;
    mesh.subdivision = how;
    d.meshes.push_back(mesh);
    d.camera.emplace().position = {0, 0, 6};
    d.lights.push_back(sky_of({1, 1, 1}));
    return d;
}
MeshData divided_mesh(const SceneDescription& d, const RasterSource& pictures, const PictureMemory& memory)
{
    std::vector<Scene::Note> notes;
    Diagnostics diagnostics;
    const auto made = divide_meshes(d, d.render, pictures, memory, notes, diagnostics);
    return made ? *made->meshes[0].data : *d.meshes[0].data;
}

}  // namespace lancer
