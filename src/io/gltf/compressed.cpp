#include "io/gltf/compressed.h"

#include <algorithm>
#include <array>

#include "core/names.h"
#include "io/gltf/module.h"
#include "io/module_file.h"

namespace lancer {
namespace {

struct GltfModule {
    decltype(&lancer_gltf_meshopt) meshopt;
    decltype(&lancer_gltf_draco_open) draco_open;
    decltype(&lancer_gltf_draco_indices) draco_indices;
    decltype(&lancer_gltf_draco_attribute) draco_attribute;
    decltype(&lancer_gltf_draco_close) draco_close;
};

GltfModule load_gltf_module()
{
    void* const library = open_module("lancer_gltf", lancer_gltf_current_version,
                                      "which reads compressed glTF files, is missing; build the target lancer_gltf (it "
                                      "needs libmeshoptimizer-dev and "
                                      "libdraco-dev) or decompress the file");
    GltfModule m = {};
    find_symbol(library, "lancer_gltf_meshopt", m.meshopt);
    find_symbol(library, "lancer_gltf_draco_open", m.draco_open);
    find_symbol(library, "lancer_gltf_draco_indices", m.draco_indices);
    find_symbol(library, "lancer_gltf_draco_attribute", m.draco_attribute);
    find_symbol(library, "lancer_gltf_draco_close", m.draco_close);
    return m;
}

const GltfModule& gltf_module()
{
    static const GltfModule loaded = load_gltf_module();  // a failure is tried again next time
    return loaded;
}

// The place of the text in the list; the first where there is none.
template <size_t n>
int32_t choice_of(const JsonValue& of, std::string_view key, const std::array<std::string_view, n>& known,
                  const GltfDocument& doc)
{
    const std::string* const text = doc.text(of, key);
    if (!text) return 0;
    const auto found = std::find(known.begin(), known.end(), *text);
    if (found == known.end()) doc.fail(of, "'" + std::string(key) + "' is " + in_quotes(*text));
    return static_cast<int32_t>(found - known.begin());
}

}  // namespace

std::vector<char> decode_meshopt(const JsonValue& e, std::string_view bytes, const GltfDocument& doc)
{
    const auto mode =
        static_cast<LancerMeshoptMode>(choice_of<3>(e, "mode", {"ATTRIBUTES", "TRIANGLES", "INDICES"}, doc));
    const auto filter = static_cast<LancerMeshoptFilter>(
        choice_of<4>(e, "filter", {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"}, doc));
    const uint64_t count = doc.whole(e, "count").value_or(0), stride = doc.whole(e, "byteStride").value_or(0);
    const bool is_attributes = mode == lancer_meshopt_attributes;
    const bool fits_mode = is_attributes ? stride > 0 && stride <= 256 && stride % 4 == 0
                                         : (stride == 2 || stride == 4) && filter == lancer_meshopt_none &&
                                               (mode == lancer_meshopt_indices || count % 3 == 0);
    const bool fits_filter = filter == lancer_meshopt_none || filter == lancer_meshopt_exponential ||
                             (filter == lancer_meshopt_octahedral && (stride == 4 || stride == 8)) ||
                             (filter == lancer_meshopt_quaternion && stride == 8);
    if (count == 0 || !fits_mode || !fits_filter) doc.fail(e, "'count', 'byteStride', 'mode' and 'filter' do not fit");
    // A byte of what is compressed makes at most 64 of a vertex, or three indices.
    constexpr uint64_t most_of_byte = 64, rest = 65536;
    if (count > (bytes.size() * most_of_byte + rest) / stride)
        doc.fail(e, "'count' is more than " + std::to_string(bytes.size()) + " bytes can make");
    constexpr size_t room = 64;
    std::vector<char> decoded(static_cast<size_t>(count * stride) + room);
    if (!gltf_module().meshopt(decoded.data(), static_cast<size_t>(count), static_cast<size_t>(stride), mode, filter,
                               bytes.data(), bytes.size()))
        doc.fail(e, "what is compressed is broken");
    decoded.resize(static_cast<size_t>(count * stride));
    return decoded;
}

struct DracoPrimitive::Decoded {
    LancerDracoInfo info{};
    std::unique_ptr<LancerDracoMesh, decltype(GltfModule::draco_close)> mesh{nullptr, nullptr};
};

DracoPrimitive::DracoPrimitive(const JsonValue& extension, GltfDocument& document, GltfBuffers& buffers)
    : extension_(extension), doc_(document), decoded_(std::make_unique<Decoded>())
{
    const JsonValue* const view = doc_.refer(extension, "bufferView", "bufferViews");
    if (!view) doc_.fail(extension, "there is no 'bufferView'");
    const std::string_view bytes = buffers.view(*view).bytes;
    decoded_->mesh = {gltf_module().draco_open(bytes.data(), bytes.size(), &decoded_->info), gltf_module().draco_close};
    if (!decoded_->mesh)
        doc_.fail(extension, std::string("what is compressed is broken: ") + on_one_line(decoded_->info.message));
}

DracoPrimitive::~DracoPrimitive() = default;

bool DracoPrimitive::has(const std::string& name) const
{
    const JsonValue* const attributes = doc_.object(extension_, "attributes");
    return attributes && attributes->member(name);
}

GltfAccessor DracoPrimitive::attribute(const std::string& name, const JsonValue& accessor) const
{
    GltfAccessor a = accessor_without_data(accessor, doc_);
    if (a.count != decoded_->info.points)
        doc_.fail(accessor, "'count' is " + std::to_string(a.count) + ", and there are " +
                                std::to_string(decoded_->info.points) + " compressed vertices");
    auto values = std::make_shared<std::vector<char>>(a.count * a.element_size());
    const uint64_t id = *doc_.whole(*doc_.object(extension_, "attributes"), name);
    if (id > UINT32_MAX || !gltf_module().draco_attribute(decoded_->mesh.get(), static_cast<uint32_t>(id),
                                                          static_cast<uint32_t>(a.components),
                                                          static_cast<int32_t>(a.type), values->data()))
        doc_.fail(extension_, "there is no compressed attribute for " + name);
    a.data = values->data(), a.owned = std::move(values);
    return a;
}

GltfAccessor DracoPrimitive::indices(const JsonValue& accessor) const
{
    GltfAccessor a = accessor_without_data(accessor, doc_);
    a.type = GltfComponent::uint32, a.components = 1, a.stride = sizeof(uint32_t);
    a.count = size_t{3} * decoded_->info.faces;
    auto values = std::make_shared<std::vector<char>>(a.count * sizeof(uint32_t));
    gltf_module().draco_indices(decoded_->mesh.get(), reinterpret_cast<uint32_t*>(values->data()));
    a.data = values->data(), a.owned = std::move(values);
    return a;
}

}  // namespace lancer
