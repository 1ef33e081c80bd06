// What glTF files have compressed, decoded by the module lancer_gltf, which is opened with the first of it.
#pragma once

#include <memory>
#include <vector>

#include "io/gltf/accessor.h"

namespace lancer {

// EXT_meshopt_compression: what a view of a buffer would hold. extension: of the view; bytes: that it names. Throws
// Error.
std::vector<char> decode_meshopt(const JsonValue& extension, std::string_view bytes, const GltfDocument& document);

// KHR_draco_mesh_compression: the numbers of a primitive.
class DracoPrimitive {
public:
    // extension: of the primitive. Throws Error.
    DracoPrimitive(const JsonValue& extension, GltfDocument& document, GltfBuffers& buffers);
    ~DracoPrimitive();
    DracoPrimitive(const DracoPrimitive&) = delete;
    DracoPrimitive& operator=(const DracoPrimitive&) = delete;

    // Whether it has the attribute of this name: else it stands in a buffer of its own.
    bool has(const std::string& name) const;
    // The accessor of an attribute or of the indices, with its numbers. Throws Error.
    GltfAccessor attribute(const std::string& name, const JsonValue& accessor) const;
    GltfAccessor indices(const JsonValue& accessor) const;

private:
    struct Decoded;
    const JsonValue& extension_;
    GltfDocument& doc_;
    std::unique_ptr<Decoded> decoded_;
};

}  // namespace lancer
