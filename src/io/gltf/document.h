// A glTF 2.0 file, text or binary (GLB), as its JSON with access that checks types and numbers of elements. Khronos
// Group, "glTF 2.0 Specification", 2021.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.h"
#include "io/file_content.h"
#include "io/gltf/json.h"
#include "io/gltf/warnings.h"

namespace lancer {

class GltfDocument {
public:
    // Throws Error: missing_input if there is no such file; invalid_input for what is no glTF 2.0, or requires an
    // extension that is not known.
    enum class Extent {
        whole,
        json
    };  // the JSON alone: of a GLB nothing else is read, and what is
        // not known is not told
    explicit GltfDocument(const std::string& path, Extent extent = Extent::whole);

    const std::string& path() const { return path_; }
    // Only of the whole.
    const FileContent& content() const { return *content_; }
    const JsonValue& root() const { return root_; }
    // Of a GLB: its binary chunk, a part of content().bytes(). Nothing if there is none.
    std::optional<std::string_view> binary() const { return binary_; }

    // Throws Error: "file: error: path of the value: what".
    [[noreturn]] void fail(const JsonValue& at, const std::string& what,
                           ErrorKind kind = ErrorKind::invalid_input) const;
    // Counts what is left out; told by warnings().
    void warn(const JsonValue& at, const std::string& kind, uint64_t times = 1);
    const GltfWarnings& warnings() const { return warnings_; }

    // Members of an object, null or nothing if it has none of that name; of another type: fail().
    const JsonValue* object(const JsonValue& of, std::string_view key) const;
    const JsonValue::Array* array(const JsonValue& of, std::string_view key) const;
    const std::string* text(const JsonValue& of, std::string_view key) const;
    std::optional<double> number(const JsonValue& of, std::string_view key) const;
    std::optional<uint64_t> whole(const JsonValue& of, std::string_view key) const;  // not negative
    bool flag(const JsonValue& of, std::string_view key) const;                      // false if there is none
    template <size_t n>
    std::optional<std::array<double, n>> numbers(const JsonValue& of, std::string_view key) const
    {
        const JsonValue::Array* const a = array(of, key);
        if (!a) return {};
        std::array<double, n> values;
        for (size_t i = 0; i < n; ++i) values[i] = a->size() == n ? number_in((*a)[i]) : fail_size(of, key, n);
        return values;
    }
    const JsonValue* extension(const JsonValue& of, std::string_view name) const;

    // A list of the root; empty if there is none.
    const JsonValue::Array& list(std::string_view key) const;
    // What the member of an object refers to by its number in a list of the root; null if there is no such member.
    const JsonValue* refer(const JsonValue& of, std::string_view key, std::string_view list) const;
    // The same for a number in an array.
    const JsonValue& refer(const JsonValue& number, std::string_view list) const;
    double number_in(const JsonValue& value) const;
    // The number of an element of a list of the root.
    size_t number_of(const JsonValue& element, std::string_view list) const;

private:
    void read_whole();
    void read_binary();
    bool read_json_of_binary();
    void read_text(std::string_view text, bool is_whole_file);
    void check_version();
    void check_required() const;
    void warn_of_extensions();
    [[noreturn]] double fail_size(const JsonValue& of, std::string_view key, size_t n) const;
    [[noreturn]] void fail_file(const std::string& what) const;

    std::string path_;
    std::optional<FileContent> content_;
    JsonValue root_;
    std::optional<std::string_view> binary_;
    GltfWarnings warnings_;
};

}  // namespace lancer
