// OBJ files, by both parsers: they agree on whether a file is one, and on its faces.
#include "io/obj/obj.h"
#include "fuzz/input.h"
#include "io/obj/check.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace lancer;
    const std::string& path = fuzz::as_file(fuzz::as_text(data, size));
    MeshOptions options;
    options.uvs = true;
    Diagnostics said, said_in_parts, notes;
    const std::shared_ptr<const MeshData> mesh = load_obj(path, said, options);
    options.parallel_from = 0;
    options.chunk = 64;
    const std::shared_ptr<const MeshData> in_parts = load_obj(path, said_in_parts, options);
    fuzz::require((mesh == nullptr) == said.has_errors() && (mesh == nullptr) == (in_parts == nullptr));
    if (mesh)
        fuzz::require(mesh->triangles == in_parts->triangles && mesh->uv_triangles == in_parts->uv_triangles &&
                      mesh->normal_triangles == in_parts->normal_triangles);
    if (mesh) check_obj_text(path, notes);
    return 0;
}
