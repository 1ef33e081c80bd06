// The bytes that a glTF file refers to: its buffers, in the file or beside it, and views of them.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/file_finder.h"
#include "io/file_part.h"
#include "io/gltf/document.h"

namespace lancer {

class GltfBuffers {
public:
    // assets: files must lie in it; null: anywhere.
    GltfBuffers(GltfDocument& document, const AssetFolder* assets) : doc_(document), finder_(document.path(), assets) {}

    struct View {
        std::string_view bytes;
        std::optional<uint64_t> stride{};  // of an element; nothing: they lie close
    };
    // Of an element of 'bufferViews'. Throws Error if it is not within its buffer, or if that cannot be had. The bytes
    // hold as long as this.
    View view(const JsonValue& buffer_view);
    // Where on disk the bytes of a view lie; nothing if they cannot be named.
    std::optional<FilePart> part_of(const JsonValue& buffer_view, const std::string& label);
    // The same of a data URI.
    std::optional<FilePart> part_of_uri(const std::string& uri, const std::string& label) const;
    // A file beside the glTF file. The URI may be percent-encoded.
    FileFinder::Found find(const std::string& uri);

    // Read besides the glTF file, in the order in which they were needed, and the hash of their bytes.
    const std::vector<std::string>& files() const { return files_; }
    uint64_t hash() const { return hash_; }
    // Of all buffers that were read, and of what was compressed in them.
    uint64_t size() const;

private:
    struct Buffer {
        std::unique_ptr<FileContent> content{};  // of a file
        std::string decoded{};                   // of a data URI
        std::string_view bytes{};
        std::string file{};  // empty: a data URI
        uint64_t begin = 0;  // of the bytes in the file
        const std::string* uri = nullptr;
    };
    std::optional<FilePart> find_base64(std::string_view text, const std::string& label) const;
    const Buffer& buffer(const JsonValue& element);
    // `of` says which, a view or what stands in its place.
    std::string_view bytes_of(const JsonValue& of);
    Buffer read(const JsonValue& element);

    GltfDocument& doc_;
    FileFinder finder_;
    std::map<size_t, Buffer> buffers_;
    std::map<size_t, std::vector<char>> decoded_views_;  // that were compressed
    std::vector<std::string> files_;
    uint64_t hash_ = 0;
};

// Whether it is "data:..."; then what of it is base64, nothing if it is not.
bool is_data_uri(std::string_view uri);
std::optional<std::string_view> base64_of_uri(std::string_view uri);

}  // namespace lancer
