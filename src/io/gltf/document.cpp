#include "io/gltf/document.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/names.h"
#include "io/input_file.h"

namespace lancer {
namespace {

constexpr std::string_view magic = "glTF";
constexpr uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;

uint32_t little_endian_at(std::string_view bytes, size_t at)
{
    uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

// Of which something is made, or which change nothing here: textures in formats beside those of the core, metadata, and
// compression that other members of the file stand for.
constexpr std::string_view known_extensions[] = {"KHR_draco_mesh_compression",
                                                 "KHR_lights_punctual",
                                                 "KHR_materials_anisotropy",
                                                 "KHR_materials_clearcoat",
                                                 "KHR_materials_emissive_strength",
                                                 "KHR_materials_ior",
                                                 "KHR_materials_iridescence",
                                                 "KHR_materials_pbrSpecularGlossiness",
                                                 "KHR_materials_sheen",
                                                 "KHR_materials_specular",
                                                 "KHR_materials_transmission",
                                                 "KHR_materials_unlit",
                                                 "KHR_materials_volume",
                                                 "KHR_materials_volume_scatter",
                                                 "KHR_mesh_quantization",
                                                 "KHR_texture_transform",
                                                 "EXT_mesh_gpu_instancing",
                                                 "EXT_meshopt_compression",
                                                 "EXT_texture_webp",
                                                 "KHR_xmp",
                                                 "KHR_xmp_json_ld"};

bool is_known(std::string_view extension)
{
    return std::find(std::begin(known_extensions), std::end(known_extensions), extension) != std::end(known_extensions);
}

const char* type_name(const JsonValue& value)
{
    constexpr std::array names{"null", "a boolean", "a number", "a string", "an array", "an object"};
    return names[value.data.index()];
}

const JsonValue::Array empty_list;

}  // namespace

GltfDocument::GltfDocument(const std::string& path, Extent extent) : path_(path)
{
    if (extent == Extent::whole || !read_json_of_binary()) read_whole();
    if (!std::holds_alternative<JsonValue::Object>(root_.data)) fail_file("not a glTF file: its JSON is no object");
    check_version();
    check_required();
    if (extent == Extent::whole) warn_of_extensions();
}

void GltfDocument::read_whole()
{
    content_.emplace(path_);
    if (content_->missing()) throw Error(ErrorKind::missing_input, {path_}, content_->problem());
    if (!content_->problem().empty()) fail_file(content_->problem());
    if (content_->bytes().starts_with(magic))
        read_binary();
    else
        read_text(content_->text(), true);
}

// False for what is no GLB whose JSON stands where it should.
bool GltfDocument::read_json_of_binary()
{
    constexpr size_t headers = 20;
    InputFile file(path_);
    std::string start(headers, '\0');
    if (file.read(start.data(), headers) != headers || !start.starts_with(magic)) return false;
    const uint32_t size = little_endian_at(start, 12);
    if (little_endian_at(start, 4) != 2 || little_endian_at(start, 16) != json_chunk || size > file.size())
        return false;
    std::string text(size, '\0');
    if (file.read(text.data(), size) != size) return false;
    read_text(text, false);
    return true;
}

void GltfDocument::fail_file(const std::string& what) const { throw Error(ErrorKind::invalid_input, {path_}, what); }

void GltfDocument::read_binary()
{
    constexpr size_t header = 12, chunk_header = 8;
    const std::string_view all = content_->bytes();
    if (all.size() < header) fail_file("the file ends in its header");
    if (const uint32_t version = little_endian_at(all, 4); version != 2)
        fail_file("a GLB file of version " + std::to_string(version) + "; known: 2");
    const uint32_t length = little_endian_at(all, 8);
    if (length > all.size())
        fail_file("the file has " + std::to_string(all.size()) + " bytes, and its header says " +
                  std::to_string(length) + ": it is cut off");
    bool has_json = false;
    for (size_t at = header; at < length;) {
        if (length - at < chunk_header) fail_file("the file ends in the header of a chunk");
        const uint32_t size = little_endian_at(all, at), type = little_endian_at(all, at + 4);
        at += chunk_header;
        if (size > length - at)
            fail_file("a chunk of " + std::to_string(size) + " bytes from byte " + std::to_string(at) +
                      " on goes beyond the end of the file");
        const std::string_view chunk = all.substr(at, size);
        if (!has_json && type != json_chunk) fail_file("the first chunk is not the JSON");
        if (type == json_chunk && !has_json) read_text(chunk, false), has_json = true;
        if (type == binary_chunk && !binary_) binary_ = chunk;
        at += size;
    }
    if (!has_json) fail_file("the file has no JSON chunk");
}

void GltfDocument::read_text(std::string_view text, bool is_whole_file)
{
    JsonProblem problem;
    std::optional<JsonValue> read = parse_json(text, problem);
    if (!read) {
        const std::string_view before = text.substr(0, std::min(problem.position, text.size()));
        const auto line = static_cast<uint32_t>(1 + std::count(before.begin(), before.end(), '\n'));
        Location where{path_};
        if (is_whole_file && problem.position > 0) where.line = line;
        throw Error(ErrorKind::invalid_input, where, "not a glTF file: no JSON: " + problem.message);
    }
    root_ = std::move(*read);
}

void GltfDocument::check_version()
{
    const JsonValue* const asset = object(root_, "asset");
    if (!asset) fail_file("not a glTF file: there is no 'asset'");
    for (const char* key : {"version", "minVersion"})
        if (const std::string* version = text(*asset, key); version && !version->starts_with("2."))
            fail(*asset, std::string(key) + " is " + in_quotes(*version) + "; known: 2.0");
    if (!text(*asset, "version")) fail(*asset, "there is no 'version'");
}

void GltfDocument::check_required() const
{
    if (const JsonValue::Array* required = array(root_, "extensionsRequired"))
        for (const JsonValue& name : *required)
            if (const auto* text = std::get_if<std::string>(&name.data); !text || !is_known(*text))
                fail(name, "the file requires an extension that is not read: " +
                               (text ? in_quotes(*text) : std::string(type_name(name))));
}

void GltfDocument::warn_of_extensions()
{
    if (const JsonValue::Array* used = array(root_, "extensionsUsed"))
        for (const JsonValue& name : *used)
            if (const auto* text = std::get_if<std::string>(&name.data); text && !is_known(*text))
                warn(name, "extension " + in_quotes(*text) + " is not read");
}

void GltfDocument::fail(const JsonValue& at, const std::string& what, ErrorKind kind) const
{
    const std::string place = path_of(root_, at);
    throw Error(kind, {path_}, (place.empty() ? "" : on_one_line(place) + ": ") + what);
}

double GltfDocument::fail_size(const JsonValue& of, std::string_view key, size_t n) const
{
    fail(*of.member(key), "not " + std::to_string(n) + " numbers");
}

void GltfDocument::warn(const JsonValue& at, const std::string& kind, uint64_t times)
{
    if (warnings_.count(kind, times)) warnings_.note(on_one_line(path_of(root_, at)));
}

const JsonValue* GltfDocument::object(const JsonValue& of, std::string_view key) const
{
    const JsonValue* const value = of.member(key);
    if (value && !std::holds_alternative<JsonValue::Object>(value->data))
        fail(*value, std::string("is ") + type_name(*value) + ", not an object");
    return value;
}

const JsonValue::Array* GltfDocument::array(const JsonValue& of, std::string_view key) const
{
    const JsonValue* const value = of.member(key);
    if (!value) return nullptr;
    const auto* const found = std::get_if<JsonValue::Array>(&value->data);
    if (!found) fail(*value, std::string("is ") + type_name(*value) + ", not an array");
    return found;
}

const std::string* GltfDocument::text(const JsonValue& of, std::string_view key) const
{
    const JsonValue* const value = of.member(key);
    if (!value) return nullptr;
    const auto* const found = std::get_if<std::string>(&value->data);
    if (!found) fail(*value, std::string("is ") + type_name(*value) + ", not a string");
    return found;
}

double GltfDocument::number_in(const JsonValue& value) const
{
    const auto* const found = std::get_if<double>(&value.data);
    if (!found) fail(value, std::string("is ") + type_name(value) + ", not a number");
    if (!std::isfinite(*found)) fail(value, "is not a finite number");
    return *found;
}

std::optional<double> GltfDocument::number(const JsonValue& of, std::string_view key) const
{
    const JsonValue* const value = of.member(key);
    return value ? std::optional(number_in(*value)) : std::nullopt;
}

std::optional<uint64_t> GltfDocument::whole(const JsonValue& of, std::string_view key) const
{
    const JsonValue* const value = of.member(key);
    if (!value) return {};
    constexpr double most = 9007199254740992.0;  // 2^53
    const double x = number_in(*value);
    if (!(x >= 0 && x < most && x == std::floor(x))) fail(*value, "is not a whole number from 0 on");
    return static_cast<uint64_t>(x);
}

bool GltfDocument::flag(const JsonValue& of, std::string_view key) const
{
    const JsonValue* const value = of.member(key);
    if (!value) return false;
    const auto* const found = std::get_if<bool>(&value->data);
    if (!found) fail(*value, std::string("is ") + type_name(*value) + ", not a boolean");
    return *found;
}

const JsonValue* GltfDocument::extension(const JsonValue& of, std::string_view name) const
{
    const JsonValue* const extensions = object(of, "extensions");
    return extensions ? object(*extensions, name) : nullptr;
}

const JsonValue::Array& GltfDocument::list(std::string_view key) const
{
    const JsonValue::Array* const found = array(root_, key);
    return found ? *found : empty_list;
}

const JsonValue* GltfDocument::refer(const JsonValue& of, std::string_view key, std::string_view list) const
{
    const JsonValue* const value = of.member(key);
    return value ? &refer(*value, list) : nullptr;
}

const JsonValue& GltfDocument::refer(const JsonValue& number, std::string_view name) const
{
    const JsonValue::Array& all = list(name);
    const double x = number_in(number);
    if (!(x >= 0 && x < static_cast<double>(all.size()) && x == std::floor(x)))
        fail(number, "there is no such element of '" + std::string(name) + "': it has " + std::to_string(all.size()));
    const JsonValue& found = all[static_cast<size_t>(x)];
    if (!std::holds_alternative<JsonValue::Object>(found.data))
        fail(found, std::string("is ") + type_name(found) + ", not an object");
    return found;
}

size_t GltfDocument::number_of(const JsonValue& element, std::string_view name) const
{
    return static_cast<size_t>(&element - list(name).data());
}

}  // namespace lancer
