// The module lancer_gltf: decodes by meshoptimizer and Draco.
#include <draco/compression/decode.h>
#include <meshoptimizer.h>

#include <cstdio>
#include <exception>
#include <memory>

#include "io/gltf/module.h"

struct LancerDracoMesh {
    std::unique_ptr<draco::Mesh> mesh;
};

namespace {

LancerDracoMesh* fail(LancerDracoInfo* info, const char* message)
{
    std::snprintf(info->message, sizeof info->message, "%s", message);
    return nullptr;
}

template <class T>
int32_t copy_attribute(const LancerDracoMesh& mesh, const draco::PointAttribute& attribute, uint32_t components,
                       void* values)
{
    T* out = static_cast<T*>(values);
    for (draco::PointIndex i(0); i < mesh.mesh->num_points(); ++i, out += components)
        if (!attribute.ConvertValue<T>(attribute.mapped_index(i), static_cast<int8_t>(components), out)) return 0;
    return 1;
}

}  // namespace

extern "C" {

int32_t lancer_gltf_version() { return lancer_gltf_current_version; }

int32_t lancer_gltf_meshopt(void* destination, size_t count, size_t stride, LancerMeshoptMode mode,
                            LancerMeshoptFilter filter, const void* bytes, size_t size)
{
    const auto* const from = static_cast<const unsigned char*>(bytes);
    const int problem =
        mode == lancer_meshopt_attributes  ? meshopt_decodeVertexBuffer(destination, count, stride, from, size)
        : mode == lancer_meshopt_triangles ? meshopt_decodeIndexBuffer(destination, count, stride, from, size)
                                           : meshopt_decodeIndexSequence(destination, count, stride, from, size);
    if (problem != 0) return 0;
    if (filter == lancer_meshopt_octahedral) meshopt_decodeFilterOct(destination, count, stride);
    if (filter == lancer_meshopt_quaternion) meshopt_decodeFilterQuat(destination, count, stride);
    if (filter == lancer_meshopt_exponential) meshopt_decodeFilterExp(destination, count, stride);
    return 1;
}

LancerDracoMesh* lancer_gltf_draco_open(const void* bytes, size_t size, LancerDracoInfo* info)
{
    try {
        draco::DecoderBuffer buffer;
        buffer.Init(static_cast<const char*>(bytes), size);
        draco::Decoder decoder;
        auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
        if (!decoded.ok()) return fail(info, decoded.status().error_msg());
        auto result = std::make_unique<LancerDracoMesh>();
        result->mesh = std::move(decoded).value();
        info->points = result->mesh->num_points();
        info->faces = result->mesh->num_faces();
        return result.release();
    } catch (const std::exception& e) {
        return fail(info, e.what());
    }
}

void lancer_gltf_draco_indices(const LancerDracoMesh* mesh, uint32_t* indices)
{
    for (draco::FaceIndex f(0); f < mesh->mesh->num_faces(); ++f)
        for (const draco::PointIndex& corner : mesh->mesh->face(f)) *indices++ = corner.value();
}

int32_t lancer_gltf_draco_attribute(const LancerDracoMesh* mesh, uint32_t id, uint32_t components,
                                    int32_t component_type, void* values)
{
    const draco::PointAttribute* const attribute = mesh->mesh->GetAttributeByUniqueId(id);
    if (!attribute || components > 16) return 0;
    switch (component_type) {
        case 5120:
            return copy_attribute<int8_t>(*mesh, *attribute, components, values);
        case 5121:
            return copy_attribute<uint8_t>(*mesh, *attribute, components, values);
        case 5122:
            return copy_attribute<int16_t>(*mesh, *attribute, components, values);
        case 5123:
            return copy_attribute<uint16_t>(*mesh, *attribute, components, values);
        case 5125:
            return copy_attribute<uint32_t>(*mesh, *attribute, components, values);
        case 5126:
            return copy_attribute<float>(*mesh, *attribute, components, values);
        default:
            return 0;
    }
}

void lancer_gltf_draco_close(LancerDracoMesh* mesh) { delete mesh; }
}
