// The primitives of glTF meshes: triangles that share a material, with the numbers that they are made of.
#pragma once

#include <map>
#include <optional>

#include "io/gltf/accessor.h"
#include "io/gltf/materials.h"

namespace lancer {

class DracoPrimitive;

struct GltfPrimitive {
    const JsonValue* json = nullptr;
    enum class Mode { triangles = 4, strip, fan };
    Mode mode = Mode::triangles;
    GltfAccessor positions;
    std::optional<GltfAccessor> normals, uvs, second_uvs, tangents, colors,
        indices;  // as many as positions, but indices
    const GltfMaterial* material = nullptr;
    size_t material_number = 0;
    // The numbers of the accessors, and of the material where it moves texture coordinates: primitives for which they
    // are the same share their vertices.
    std::array<size_t, 7> key{};

    size_t corners() const { return indices ? indices->count : positions.count; }
    size_t triangles() const { return mode == Mode::triangles ? corners() / 3 : corners() < 3 ? 0 : corners() - 2; }
};

// Opens primitives, and reads each material once, when the first primitive wears it.
class GltfPrimitives {
public:
    // keeps_uvs: TEXCOORD_0 and 1, and tangents, even where a material has no texture.
    GltfPrimitives(GltfDocument& document, GltfBuffers& buffers, bool keeps_uvs)
        : doc_(document), buffers_(buffers), textures_(document, buffers), keeps_uvs_(keeps_uvs)
    {
    }
    // Of a mesh. What is no triangle is counted as left out. Throws Error for what is wrong.
    std::vector<GltfPrimitive> open(const JsonValue& mesh);
    // Those read so far, by their numbers; one more for what names none.
    const std::map<size_t, GltfMaterial>& materials() const { return materials_; }

private:
    std::optional<GltfPrimitive> open_one(const JsonValue& primitive);
    std::optional<GltfAccessor> attribute(GltfPrimitive& p, const JsonValue& attributes, const std::string& name,
                                          size_t slot, const DracoPrimitive* draco);
    void choose_material(GltfPrimitive& p);

    GltfDocument& doc_;
    GltfBuffers& buffers_;
    GltfTextures textures_;
    bool keeps_uvs_;
    std::map<size_t, GltfMaterial> materials_;
    size_t compressed_ = 0;  // primitives by Draco
};

}  // namespace lancer
