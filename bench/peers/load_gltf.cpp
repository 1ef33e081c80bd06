// Reads a GLB file by tinygltf alone, which copies its buffers and leaves them as they are: prints the seconds by the
// clock, CPU seconds and triangles. See `loaders`.
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include "load_time.h"

int main(int, char** argv)
{
    const LoadTime time;
    tinygltf::TinyGLTF loader;
    tinygltf::Model model;
    std::string error, warning;
    if (!loader.LoadBinaryFromFile(&model, &error, &warning, argv[1])) return 1;
    size_t triangles = 0;
    for (const tinygltf::Mesh& mesh : model.meshes)
        for (const tinygltf::Primitive& p : mesh.primitives)
            triangles += model.accessors[static_cast<size_t>(p.indices)].count / 3;
    return time.print(triangles);
}
