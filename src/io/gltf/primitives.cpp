#include "io/gltf/primitives.h"

#include "io/gltf/compressed.h"

namespace lancer {
namespace {

constexpr size_t no_accessor = SIZE_MAX;

void check_shape(const GltfAccessor& a, const std::string& name, const GltfDocument& doc)
{
    const bool is_color = name == "COLOR_0", is_uv = name.starts_with("TEXCOORD");
    const size_t wanted = is_uv ? 2 : name == "TANGENT" ? 4 : 3;
    const bool fits = is_color ? a.components == 3 || a.components == 4 : a.components == wanted;
    if (!fits) doc.fail(*a.json, "has " + std::to_string(a.components) + " components, which " + name + " has not");
}

}  // namespace

std::vector<GltfPrimitive> GltfPrimitives::open(const JsonValue& mesh)
{
    std::vector<GltfPrimitive> all;
    const JsonValue::Array* const primitives = doc_.array(mesh, "primitives");
    if (!primitives) doc_.fail(mesh, "there are no 'primitives'");
    for (const JsonValue& primitive : *primitives)
        if (std::optional<GltfPrimitive> p = open_one(primitive)) all.push_back(std::move(*p));
    return all;
}

std::optional<GltfAccessor> GltfPrimitives::attribute(GltfPrimitive& p, const JsonValue& attributes,
                                                      const std::string& name, size_t slot, const DracoPrimitive* draco)
{
    p.key[slot] = no_accessor;
    const JsonValue* const json = doc_.refer(attributes, name, "accessors");
    if (!json) return {};
    p.key[slot] = doc_.number_of(*json, "accessors");
    const GltfAccessor a =
        draco && draco->has(name) ? draco->attribute(name, *json) : open_accessor(*json, doc_, buffers_);
    check_shape(a, name, doc_);
    if (slot > 0 && a.count != p.positions.count)
        doc_.fail(*p.json, name + " has " + std::to_string(a.count) + " elements, and POSITION " +
                               std::to_string(p.positions.count));
    return a;
}

void GltfPrimitives::choose_material(GltfPrimitive& p)
{
    const JsonValue* const json = doc_.refer(*p.json, "material", "materials");
    p.material_number = json ? doc_.number_of(*json, "materials") : doc_.list("materials").size();
    const auto [entry, is_new] = materials_.try_emplace(p.material_number);
    if (is_new) entry->second = read_gltf_material(json, doc_, textures_);
    p.material = &entry->second;
}

std::optional<GltfPrimitive> GltfPrimitives::open_one(const JsonValue& primitive)
{
    GltfPrimitive p;
    p.json = &primitive;
    const uint64_t mode = doc_.whole(primitive, "mode").value_or(4);
    if (mode > 6) doc_.fail(primitive, "'mode' is " + std::to_string(mode) + "; known: 0 to 6");
    if (mode < 4) {
        doc_.warn(primitive, "points and lines are left out");
        return {};
    }
    p.mode = static_cast<GltfPrimitive::Mode>(mode);
    const JsonValue* const attributes = doc_.object(primitive, "attributes");
    if (!attributes) doc_.fail(primitive, "there are no 'attributes'");
    std::optional<DracoPrimitive> compressed;
    if (const JsonValue* e = doc_.extension(primitive, "KHR_draco_mesh_compression"))
        compressed.emplace(*e, doc_, buffers_);
    const DracoPrimitive* const draco = compressed ? &*compressed : nullptr;
    std::optional<GltfAccessor> positions = attribute(p, *attributes, "POSITION", 0, draco);
    if (!positions) {
        doc_.warn(primitive, "a primitive without POSITION is left out");
        return {};
    }
    p.positions = std::move(*positions);
    choose_material(p);
    p.normals = attribute(p, *attributes, "NORMAL", 1, draco);
    const bool reads = reads_textures(p.material->description);
    p.key[2] = p.key[5] = p.key[6] = no_accessor;
    if (reads || keeps_uvs_) {
        const auto uvs_of = [&](uint64_t set, size_t slot) {
            return attribute(p, *attributes, "TEXCOORD_" + std::to_string(set), slot, draco);
        };
        const auto& [first, second] = p.material->uv_sets;
        p.uvs = uvs_of(first.value_or(0), 2);
        if (!p.uvs && reads)
            doc_.warn(primitive, "a primitive without the texture coordinates of its material has one texel for all");
        // Materials of a scene file call TEXCOORD_1 the second set.
        if (p.uvs && (second || (keeps_uvs_ && first.value_or(0) != 1))) p.second_uvs = uvs_of(second.value_or(1), 5);
        if (p.uvs && second && !p.second_uvs)
            doc_.warn(primitive,
                      "a primitive lacks the second set of texture coordinates of its material: the first is used");
        // As the format says, tangents without normals do not count.
        if (p.uvs && p.normals && (keeps_uvs_ || p.material->description.normal_map))
            p.tangents = attribute(p, *attributes, "TANGENT", 6, draco);
    }
    p.colors = attribute(p, *attributes, "COLOR_0", 3, draco);
    const auto& moves = p.material->uv_transforms;
    p.key[4] = moves[0] || moves[1] ? p.material_number : no_accessor;
    if (const JsonValue* indices = doc_.refer(primitive, "indices", "accessors"))
        p.indices = draco ? draco->indices(*indices) : open_accessor(*indices, doc_, buffers_);
    if (draco) p.key[4] = doc_.list("materials").size() + 1 + compressed_++;  // shares vertices with none
    if (doc_.array(primitive, "targets")) doc_.warn(primitive, "morph targets are not used");
    if (p.mode == GltfPrimitive::Mode::triangles && p.corners() % 3 != 0)
        doc_.warn(primitive, "corners left over after the last triangle are left out", p.corners() % 3);
    return p;
}

}  // namespace lancer
