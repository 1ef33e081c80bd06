// PLY files: a mesh whose numbers are in range, or an error.
#include "io/ply/ply.h"
#include "fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace lancer;
    const std::string& path = fuzz::as_file(fuzz::as_text(data, size));
    MeshOptions options;
    options.uvs = true;
    Diagnostics said;
    const std::shared_ptr<const MeshData> mesh = load_ply(path, said, options);
    fuzz::require((mesh == nullptr) == said.has_errors());
    if (!mesh) return 0;
    for (const auto& t : mesh->triangles)
        for (const uint32_t corner : t) fuzz::require(corner < mesh->positions.size());
    for (const auto& t : mesh->uv_triangles)
        for (const uint32_t corner : t) fuzz::require(corner < mesh->uvs.size() || corner == MeshData::no_uv);
    fuzz::require(mesh->uv_triangles.empty() || mesh->uv_triangles.size() == mesh->triangles.size());
    return 0;
}
