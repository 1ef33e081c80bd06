// glTF files: a mesh whose numbers are in range, or an error; and tables of cameras and lights, or an Error.
#include "io/gltf/gltf.h"
#include "fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace lancer;
    const std::string& path = fuzz::as_file(fuzz::as_text(data, size));
    MeshOptions options;
    options.uvs = true;
    Diagnostics said;
    const std::shared_ptr<const MeshData> mesh = load_gltf(path, said, options);
    fuzz::require((mesh == nullptr) == said.has_errors());
    try {
        Diagnostics none;
        gltf_tables(path, none);
    } catch (const Error&) {
    }
    if (!mesh) return 0;
    const size_t count = mesh->triangles.size();
    for (const auto& t : mesh->triangles)
        for (const uint32_t corner : t) fuzz::require(corner < mesh->positions.size());
    for (const auto& t : mesh->normal_triangles)
        for (const uint32_t corner : t) fuzz::require(corner < mesh->normals.size() || corner == MeshData::no_normal);
    for (const auto& t : mesh->uv_triangles)
        for (const uint32_t corner : t) fuzz::require(corner < mesh->uvs.size() || corner == MeshData::no_uv);
    for (const uint32_t material : mesh->face_material) fuzz::require(material < mesh->materials.size());
    fuzz::require(mesh->normal_triangles.empty() || mesh->normal_triangles.size() == count);
    fuzz::require(mesh->uv_triangles.empty() || mesh->uv_triangles.size() == count);
    fuzz::require(mesh->face_material.empty() || mesh->face_material.size() == count);
    fuzz::require(mesh->colors.empty() || mesh->colors.size() == mesh->positions.size());
    return 0;
}
