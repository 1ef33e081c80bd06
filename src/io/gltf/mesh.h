// Makes one mesh of the primitives of a glTF file, each where its node places it.
#pragma once

#include <map>
#include <vector>

#include "core/transform.h"
#include "io/gltf/primitives.h"
#include "io/smoothing.h"
#include "scene/description/description.h"

namespace lancer {

class GltfMeshBuilder {
public:
    GltfMeshBuilder(GltfDocument& document, MeshData& mesh) : doc_(document), mesh_(mesh) {}

    // Room for what add() will add, so that nothing is copied meanwhile. Throws Error if that is too much.
    void reserve(size_t vertices, size_t triangles);
    // Primitives of one mesh, which share vertices where they name the same. Throws Error for what is wrong. Triangles
    // without area are dropped; a map that mirrors turns triangles round.
    void add(const std::vector<GltfPrimitive>& primitives, const Transform& to_world);
    // Completes the mesh. Its triangles have normals as their primitives have; smoothing: for where none has any.
    void finish(const Smoothing& smoothing);

private:
    struct Vertices {
        size_t first = 0;
        bool has_normals = false, has_uvs = false;
    };
    // Triangles of one primitive.
    struct Range {
        size_t first = 0, count = 0;
        Vertices vertices;
        uint32_t material = 0;
    };
    Vertices add_vertices(const GltfPrimitive& p, const Transform& to_world);
    void add_positions(const GltfPrimitive& p, const Transform& to_world, size_t first);
    void add_uvs(const GltfPrimitive& p, size_t first);
    void add_tangents(const GltfPrimitive& p, const Transform& to_world, size_t first);
    void add_colors(const GltfPrimitive& p, size_t first);
    void add_triangles(const GltfPrimitive& p, const Vertices& vertices, bool turns);
    uint32_t slot_of(const GltfPrimitive& p);
    void finish_normals();
    void finish_uvs();

    GltfDocument& doc_;
    MeshData& mesh_;
    std::vector<Range> ranges_;
    std::map<size_t, uint32_t> slots_;  // of materials, by their numbers in the file
};

}  // namespace lancer
