#include "io/gltf/accessor.h"

namespace lancer {
namespace {

class AccessorReader {
public:
    AccessorReader(const JsonValue& json, GltfDocument& doc) : json_(json), doc_(doc) {}

    GltfAccessor read_without_data()
    {
        a_.json = &json_;
        const std::optional<uint64_t> count = doc_.whole(json_, "count");
        const std::string* const type = doc_.text(json_, "type");
        if (!count || *count == 0) doc_.fail(json_, "there is no 'count', or it is 0");
        if (!type) doc_.fail(json_, "there is no 'type'");
        const std::optional<size_t> components = components_of(*type);
        if (!components) doc_.fail(json_, "'type' is none of SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 and MAT4");
        a_.count = static_cast<size_t>(*count), a_.components = *components;
        a_.type = component_type(json_);
        a_.normalized = doc_.flag(json_, "normalized");
        a_.stride = a_.element_size();
        return a_;
    }
    GltfAccessor read(GltfBuffers& buffers)
    {
        read_without_data();
        if (const JsonValue* view = doc_.refer(json_, "bufferView", "bufferViews"))
            take_data(*view, buffers);
        else
            check_room(buffers);
        if (const JsonValue* sparse = doc_.object(json_, "sparse")) take_sparse(*sparse, buffers);
        return a_;
    }

private:
    GltfComponent component_type(const JsonValue& of) const
    {
        const uint64_t type = doc_.whole(of, "componentType").value_or(0);
        if (type != 5120 && type != 5121 && type != 5122 && type != 5123 && type != 5125 && type != 5126)
            doc_.fail(of, "'componentType' is " + std::to_string(type) + "; known: 5120 to 5123, 5125, 5126");
        return static_cast<GltfComponent>(type);
    }

    void take_data(const JsonValue& json_view, GltfBuffers& buffers)
    {
        const GltfBuffers::View view = buffers.view(json_view);
        const uint64_t offset = doc_.whole(json_, "byteOffset").value_or(0);
        if (view.stride) {
            if (*view.stride < a_.element_size())
                doc_.fail(json_view, "'byteStride' is less than the " + std::to_string(a_.element_size()) +
                                         " bytes of an element");
            a_.stride = static_cast<size_t>(std::min<uint64_t>(*view.stride, view.bytes.size() + a_.element_size()));
        }
        a_.data = data_in(view.bytes, offset, a_.count, a_.stride, a_.element_size(), json_);
    }

    // An element of `size` bytes at each stride. No sum here can overflow: strides are at most the size of a view.
    const char* data_in(std::string_view bytes, uint64_t offset, size_t count, size_t stride, size_t size,
                        const JsonValue& at) const
    {
        if (offset > bytes.size() || size > bytes.size() - offset ||
            count - 1 > (bytes.size() - offset - size) / stride)
            doc_.fail(at, std::to_string(count) + " elements from byte " + std::to_string(offset) +
                              " on are not within the buffer view, which has " + std::to_string(bytes.size()) +
                              " bytes");
        return bytes.data() + offset;
    }

    // Without data all are zero. No memory is taken for more than a file of this size can be meant to have.
    void check_room(const GltfBuffers& buffers) const
    {
        if (a_.count > buffers.size() + doc_.content().bytes().size())
            doc_.fail(json_,
                      std::to_string(a_.count) + " elements without a buffer view are more than the file can mean");
    }

    void take_sparse(const JsonValue& sparse, GltfBuffers& buffers)
    {
        const std::optional<uint64_t> count = doc_.whole(sparse, "count");
        const JsonValue* const indices = doc_.object(sparse, "indices");
        const JsonValue* const values = doc_.object(sparse, "values");
        if (!count || *count == 0 || *count > a_.count || !indices || !values)
            doc_.fail(sparse, "there is no 'count' from 1 to that of the accessor, no 'indices' or no 'values'");
        a_.sparse.count = static_cast<size_t>(*count);
        a_.sparse.index_type = component_type(*indices);
        if (a_.sparse.index_type != GltfComponent::uint8 && a_.sparse.index_type != GltfComponent::uint16 &&
            a_.sparse.index_type != GltfComponent::uint32)
            doc_.fail(*indices, "'componentType' of indices is none of 5121, 5123 and 5125");
        a_.sparse.indices = part_of_sparse(*indices, size_of(a_.sparse.index_type), buffers);
        a_.sparse.values = part_of_sparse(*values, a_.element_size(), buffers);
        for (size_t i = 0; i < a_.sparse.count; ++i)
            if (index_at(a_.sparse.indices, a_.sparse.index_type, i) >= a_.count)
                doc_.fail(*indices, "index " + std::to_string(i) + " is not less than the 'count' of the accessor");
    }
    const char* part_of_sparse(const JsonValue& part, size_t size, GltfBuffers& buffers) const
    {
        const JsonValue* const view = doc_.refer(part, "bufferView", "bufferViews");
        if (!view) doc_.fail(part, "there is no 'bufferView'");
        return data_in(buffers.view(*view).bytes, doc_.whole(part, "byteOffset").value_or(0), a_.sparse.count, size,
                       size, part);
    }

    const JsonValue& json_;
    GltfDocument& doc_;
    GltfAccessor a_;
};

}  // namespace

std::optional<size_t> components_of(std::string_view type)
{
    constexpr std::pair<std::string_view, size_t> known[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                                                             {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
    for (const auto& [name, count] : known)
        if (name == type) return count;
    return {};
}

GltfAccessor open_accessor(const JsonValue& accessor, GltfDocument& document, GltfBuffers& buffers)
{
    return AccessorReader(accessor, document).read(buffers);
}

GltfAccessor accessor_without_data(const JsonValue& accessor, GltfDocument& document)
{
    return AccessorReader(accessor, document).read_without_data();
}

size_t index_at(const char* data, GltfComponent type, size_t i)
{
    const char* const at = data + i * size_of(type);
    size_t index = SIZE_MAX;
    gltf_numbers::with_type(type, [&]<class T>(T) {
        if constexpr (std::is_unsigned_v<T>) {
            T value;
            std::memcpy(&value, at, sizeof value);
            index = value;
        }
    });
    return index;
}

GltfIndices::GltfIndices(const GltfAccessor& accessor, const GltfDocument& document) : accessor_(accessor)
{
    const bool is_unsigned = accessor.type == GltfComponent::uint8 || accessor.type == GltfComponent::uint16 ||
                             accessor.type == GltfComponent::uint32;
    if (accessor.components != 1 || !is_unsigned)
        document.fail(*accessor.json, "indices are not single numbers of componentType 5121, 5123 or 5125");
    if (accessor.sparse.count == 0) return;
    std::vector<uint32_t> own(accessor.count);
    for_each_element<1>(accessor,
                        [&](size_t i, const std::array<double, 1>& v) { own[i] = static_cast<uint32_t>(v[0]); });
    own_ = std::move(own);
}

}  // namespace lancer
