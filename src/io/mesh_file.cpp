#include "io/mesh_file.h"

#include "io/file_name.h"
#include "io/gltf/gltf.h"
#include "io/obj/obj.h"
#include "io/ply/ply.h"

namespace lancer {

std::shared_ptr<const MeshData> load_mesh(const std::string& path, Diagnostics& diagnostics, const MeshOptions& options)
{
    if (is_gltf(path)) return load_gltf(path, diagnostics, options);
    return mesh_extension_of(path) == ".ply" ? load_ply(path, diagnostics, options)
                                             : load_obj(path, diagnostics, options);
}

}  // namespace lancer
