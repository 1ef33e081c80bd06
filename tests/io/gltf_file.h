// Makes small glTF files for tests: numbers go into one buffer, each list of them with an accessor and a view of its
// own.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace lancer {

// Standard base64, with padding.
inline std::string to_base64(const std::string& bytes)
{
    const char* const letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : letters[bits >> (18 - 6 * k) & 63];
    }
    return text;
}

class GltfFile {
public:
    // Of the type T, each element of `stride` bytes, or close. more: members of the accessor. Returns its number.
    template <class T>
    size_t add(const std::vector<double>& values, const std::string& type, const std::string& more = "",
               size_t stride = 0)
    {
        const size_t n = type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : 4;
        const size_t own = n * sizeof(T), step = stride ? stride : own;
        std::string bytes;
        for (size_t i = 0; i < values.size(); i += n) {
            for (size_t c = 0; c < n; ++c) {
                const T value = static_cast<T>(values[i + c]);
                char raw[sizeof(T)];
                std::memcpy(raw, &value, sizeof(T));
                bytes.append(raw, sizeof(T));
            }
            bytes.append(i + n < values.size() ? step - own : 0, '\x5a');
        }
        const size_t view = add_view(bytes, stride ? ",\"byteStride\":" + std::to_string(stride) : "");
        return add_accessor("\"bufferView\":" + std::to_string(view) + ",\"componentType\":" +
                            std::to_string(component<T>()) + ",\"count\":" + std::to_string(values.size() / n) +
                            ",\"type\":\"" + type + "\"" + (more.empty() ? "" : "," + more));
    }
    size_t add_accessor(const std::string& members)
    {
        accessors_.push_back("{" + members + "}");
        return accessors_.size() - 1;
    }
    size_t add_view(const std::string& bytes, const std::string& more = "")
    {
        binary.append((4 - binary.size() % 4) % 4, '\0');
        views_.push_back("{\"buffer\":0,\"byteOffset\":" + std::to_string(binary.size()) +
                         ",\"byteLength\":" + std::to_string(bytes.size()) + more + "}");
        binary += bytes;
        return views_.size() - 1;
    }
    // A mesh of one primitive, and a node with it. Members of the primitive, and of the node.
    void add_mesh(const std::string& primitive, const std::string& node = "")
    {
        meshes_.push_back("{\"primitives\":[{" + primitive + "}]}");
        nodes_.push_back("{\"mesh\":" + std::to_string(meshes_.size() - 1) + (node.empty() ? "" : "," + node) + "}");
    }
    void add_node(const std::string& members) { nodes_.push_back("{" + members + "}"); }

    // Members of the root besides those that are made here.
    std::string rest{};
    std::string roots{};  // of the scene; empty: all nodes
    std::string generator{};
    std::string binary{};

    // uri: of the buffer; empty: none, as of a GLB.
    std::string json(const std::string& uri) const
    {
        std::string all;
        for (size_t i = 0; i < nodes_.size(); ++i) all += (i ? "," : "") + std::to_string(i);
        return "{\"asset\":{\"version\":\"2.0\"" + (generator.empty() ? "" : ",\"generator\":\"" + generator + "\"") +
               "},\"scene\":0,\"scenes\":[{\"nodes\":[" + (roots.empty() ? all : roots) + "]}],\"nodes\":[" +
               joined(nodes_) + "],\"meshes\":[" + joined(meshes_) + "],\"accessors\":[" + joined(accessors_) +
               "],\"bufferViews\":[" + joined(views_) +
               "],\"buffers\":[{\"byteLength\":" + std::to_string(binary.size()) +
               (uri.empty() ? "" : ",\"uri\":\"" + uri + "\"") + "}]" + (rest.empty() ? "" : "," + rest) + "}";
    }
    std::string embedded() const { return json("data:application/octet-stream;base64," + to_base64(binary)); }
    std::string glb() const
    {
        std::string text = json(""), bytes = binary;
        text.append((4 - text.size() % 4) % 4, ' ');
        bytes.append((4 - bytes.size() % 4) % 4, '\0');
        return "glTF" + word(2) + word(12 + 8 + text.size() + 8 + bytes.size()) + word(text.size()) + "JSON" + text +
               word(bytes.size()) + std::string("BIN\0", 4) + bytes;
    }

    static std::string word(size_t value)
    {
        const auto number = static_cast<uint32_t>(value);
        std::string raw(4, '\0');
        std::memcpy(raw.data(), &number, 4);
        return raw;
    }

private:
    template <class T>
    static int component()
    {
        return std::is_same_v<T, int8_t>     ? 5120
               : std::is_same_v<T, uint8_t>  ? 5121
               : std::is_same_v<T, int16_t>  ? 5122
               : std::is_same_v<T, uint16_t> ? 5123
               : std::is_same_v<T, uint32_t> ? 5125
                                             : 5126;
    }
    static std::string joined(const std::vector<std::string>& parts)
    {
        std::string all;
        for (size_t i = 0; i < parts.size(); ++i) all += (i ? "," : "") + parts[i];
        return all;
    }

    std::vector<std::string> accessors_, views_, meshes_, nodes_;
};

}  // namespace lancer
