#include "io/gltf/nodes.h"

#include <cmath>

namespace lancer {
namespace {

// An affine map by its columns.
Transform transform_of_matrix(const std::array<double, 16>& m, const JsonValue& node, const GltfDocument& doc)
{
    constexpr double tolerance = 1e-6;
    if (std::abs(m[3]) > tolerance || std::abs(m[7]) > tolerance || std::abs(m[11]) > tolerance ||
        std::abs(m[15] - 1) > tolerance)
        doc.fail(node, "the fourth row of the matrix is not 0 0 0 1");
    return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
}

Transform transform_of(const JsonValue& node, const GltfDocument& doc)
{
    if (const auto m = doc.numbers<16>(node, "matrix")) return transform_of_matrix(*m, node, doc);
    GltfParts parts;
    parts.translation = doc.numbers<3>(node, "translation").value_or(parts.translation);
    parts.scale = doc.numbers<3>(node, "scale").value_or(parts.scale);
    parts.rotation = doc.numbers<4>(node, "rotation").value_or(parts.rotation);
    const std::optional<Transform> m = transform_of(parts);
    if (!m) doc.fail(node, "the rotation is no quaternion that can be normalised");
    return *m;
}

class NodeWalk {
public:
    explicit NodeWalk(GltfDocument& doc) : doc_(doc), met_(doc.list("nodes").size()) {}

    GltfScene run()
    {
        if (met_.empty() && doc_.list("scenes").empty()) {
            for (const JsonValue& mesh : doc_.list("meshes")) found_.meshes.push_back({nullptr, &mesh, {}});
            return std::move(found_);
        }
        push_roots();
        while (!open_.empty()) {
            const auto [node, parent] = open_.back();
            open_.pop_back();
            visit(*node, parent);
        }
        return std::move(found_);
    }

private:
    struct Open {
        const JsonValue* node;
        Transform parent;
    };

    void push_roots()
    {
        const JsonValue* scene = doc_.refer(doc_.root(), "scene", "scenes");
        if (!scene && !doc_.list("scenes").empty()) scene = &doc_.refer({.data = 0.0}, "scenes");
        if (scene) {
            push_all(doc_.array(*scene, "nodes"), {});
            return;
        }
        std::vector<bool> is_child(met_.size());
        for (const JsonValue& node : doc_.list("nodes"))
            if (const JsonValue::Array* children = doc_.array(node, "children"))
                for (const JsonValue& child : *children)
                    is_child[doc_.number_of(doc_.refer(child, "nodes"), "nodes")] = true;
        const JsonValue::Array& nodes = doc_.list("nodes");
        for (size_t i = nodes.size(); i > 0; --i)
            if (!is_child[i - 1]) open_.push_back({&nodes[i - 1], {}});
    }

    // The last one first, as the first one on the stack is the last one visited.
    void push_all(const JsonValue::Array* numbers, const Transform& parent)
    {
        if (!numbers) return;
        for (auto number = numbers->rbegin(); number != numbers->rend(); ++number)
            open_.push_back({&doc_.refer(*number, "nodes"), parent});
    }

    void visit(const JsonValue& node, const Transform& parent)
    {
        const size_t number = doc_.number_of(node, "nodes");
        if (met_[number]) doc_.fail(node, "the node is reached twice: nodes must form a tree");
        met_[number] = true;
        const Transform here = compose(parent, transform_of(node, doc_));
        if (!is_finite(here)) doc_.fail(node, "the transform has numbers that are not finite");
        if (const JsonValue* mesh = doc_.refer(node, "mesh", "meshes")) found_.meshes.push_back({&node, mesh, here});
        if (const JsonValue* camera = doc_.refer(node, "camera", "cameras"))
            found_.cameras.push_back({&node, camera, here});
        if (const JsonValue* light = light_of(node)) found_.lights.push_back({&node, light, here});
        push_all(doc_.array(node, "children"), here);
    }

    const JsonValue* light_of(const JsonValue& node) const
    {
        constexpr const char* name = "KHR_lights_punctual";
        const JsonValue* const use = doc_.extension(node, name);
        const std::optional<uint64_t> number = use ? doc_.whole(*use, "light") : std::nullopt;
        if (!number) return nullptr;
        const JsonValue* const all = doc_.extension(doc_.root(), name);
        const JsonValue::Array* const lights = all ? doc_.array(*all, "lights") : nullptr;
        if (!lights || *number >= lights->size()) doc_.fail(*use, "there is no such light");
        return &(*lights)[static_cast<size_t>(*number)];
    }

    GltfDocument& doc_;
    std::vector<bool> met_;
    std::vector<Open> open_;
    GltfScene found_;
};

}  // namespace

std::optional<Transform> transform_of(const GltfParts& parts)
{
    std::array<double, 4> q = parts.rotation;
    const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(size > 0 && std::isfinite(size))) return {};
    if (size != 1)
        for (double& part : q) part /= size;
    const auto [x, y, z, w] = q;
    const Vec3d columns[]{{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
                          {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
                          {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}};
    const auto& [tx, ty, tz] = parts.translation;
    return Transform{
        columns[0] * parts.scale[0], columns[1] * parts.scale[1], columns[2] * parts.scale[2], {tx, ty, tz}};
}

GltfScene read_gltf_nodes(GltfDocument& document) { return NodeWalk(document).run(); }

}  // namespace lancer
