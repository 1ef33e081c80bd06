// Reads an OBJ file by tinyobjloader alone: prints the seconds by the clock, CPU seconds and triangles. See `loaders`.
#include <tiny_obj_loader.h>

#include "load_time.h"

int main(int, char** argv)
{
    const LoadTime time;
    tinyobj::ObjReader reader;
    if (!reader.ParseFromFile(argv[1])) return 1;
    size_t triangles = 0;
    for (const tinyobj::shape_t& shape : reader.GetShapes()) triangles += shape.mesh.num_face_vertices.size();
    return time.print(triangles);
}
