#include "io/gltf/instances.h"

#include <atomic>

#include "io/gltf/accessor.h"
#include "io/gltf/nodes.h"

namespace lancer {
namespace {

class InstanceReader {
public:
    InstanceReader(const JsonValue& attributes, GltfDocument& document, GltfBuffers& buffers)
        : attributes_(attributes), doc_(document), buffers_(buffers)
    {
    }

    std::optional<std::vector<Transform>> read()
    {
        read_part("TRANSLATION", &GltfParts::translation);
        read_part("ROTATION", &GltfParts::rotation);
        read_part("SCALE", &GltfParts::scale);
        if (!count_) return {};
        std::vector<Transform> all(*count_);
        std::atomic<size_t> unfit = SIZE_MAX;
        for_each_index(all.size(), [&](size_t i) {
            const std::optional<Transform> m = transform_of(parts_[i]);
            all[i] = m.value_or(Transform{});
            if (!m || !is_finite(*m)) unfit = i;
        });
        if (unfit != SIZE_MAX)
            doc_.fail(attributes_, "instance " + std::to_string(unfit) +
                                       " has numbers that are not finite, or a rotation that cannot be normalised");
        return all;
    }

private:
    template <size_t n>
    void read_part(const char* name, std::array<double, n> GltfParts::*part)
    {
        const JsonValue* const json = doc_.refer(attributes_, name, "accessors");
        if (!json) return;
        const GltfAccessor accessor = open_accessor(*json, doc_, buffers_);
        if (accessor.components != n)
            doc_.fail(*json, std::string(name) + " of instances has not " + std::to_string(n) + " components");
        if (count_.value_or(accessor.count) != accessor.count)
            doc_.fail(attributes_, "the accessors of instances have different counts");
        count_ = accessor.count;
        parts_.resize(accessor.count);
        for_each_element<n>(accessor, [&](size_t i, const std::array<double, n>& v) { parts_[i].*part = v; });
    }

    const JsonValue& attributes_;
    GltfDocument& doc_;
    GltfBuffers& buffers_;
    std::optional<size_t> count_;
    std::vector<GltfParts> parts_;
};

}  // namespace

std::optional<std::vector<Transform>> read_gltf_instances(const JsonValue& node, GltfDocument& document,
                                                          GltfBuffers& buffers)
{
    const JsonValue* const extension = document.extension(node, "EXT_mesh_gpu_instancing");
    const JsonValue* const attributes = extension ? document.object(*extension, "attributes") : nullptr;
    if (!attributes) return {};
    return InstanceReader(*attributes, document, buffers).read();
}

}  // namespace lancer
