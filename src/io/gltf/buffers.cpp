#include "io/gltf/buffers.h"

#include <algorithm>

#include "core/hash.h"
#include "core/names.h"
#include "io/base64.h"
#include "io/gltf/compressed.h"

namespace lancer {
namespace {

constexpr std::string_view data_scheme = "data:", base64_mark = ";base64,";

// %20 and the like become characters (RFC 3986, section 2.1).
std::string without_percents(const std::string& uri)
{
    const auto digit = [](char c) {
        if (c >= '0' && c <= '9') return c - '0';
        c = to_lower(c);
        return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
    };
    std::string text;
    for (size_t i = 0; i < uri.size(); ++i) {
        const int high = i + 2 < uri.size() ? digit(uri[i + 1]) : -1, low = i + 2 < uri.size() ? digit(uri[i + 2]) : -1;
        const bool is_code = uri[i] == '%' && high >= 0 && low >= 0;
        text += is_code ? static_cast<char>(16 * high + low) : uri[i];
        if (is_code) i += 2;
    }
    return text;
}

std::string with_escaped_slashes(std::string_view text)
{
    std::string escaped;
    for (const char c : text) (c == '/' ? escaped += '\\' : escaped) += c;
    return escaped;
}

// Of what a text stands for, if it is base64.
uint64_t decoded_size(std::string_view base64)
{
    while (!base64.empty() && base64.back() == '=') base64.remove_suffix(1);
    return base64.size() / 4 * 3 + (base64.size() % 4 > 1 ? base64.size() % 4 - 1 : 0);
}

}  // namespace

bool is_data_uri(std::string_view uri) { return to_lower(uri.substr(0, data_scheme.size())) == data_scheme; }

std::optional<std::string_view> base64_of_uri(std::string_view uri)
{
    const size_t mark = uri.substr(0, 256).find(base64_mark);
    if (!is_data_uri(uri) || mark == std::string_view::npos) return {};
    return uri.substr(mark + base64_mark.size());
}

FileFinder::Found GltfBuffers::find(const std::string& uri)
{
    FileFinder::Found found = finder_.find(without_percents(uri));
    if (found.path.empty() && uri.find('%') != std::string::npos) {
        FileFinder::Found as_written = finder_.find(uri);
        if (!as_written.path.empty()) return as_written;
    }
    return found;
}

GltfBuffers::Buffer GltfBuffers::read(const JsonValue& element)
{
    Buffer b;
    const std::optional<uint64_t> length = doc_.whole(element, "byteLength");
    if (!length) doc_.fail(element, "there is no 'byteLength'");
    b.uri = doc_.text(element, "uri");
    if (!b.uri) {
        if (!doc_.binary() || doc_.number_of(element, "buffers") != 0)
            doc_.fail(element, "there is no 'uri', and the bytes are not those of a GLB file");
        b.file = doc_.path();
        b.bytes = *doc_.binary();
        b.begin = static_cast<uint64_t>(b.bytes.data() - doc_.content().bytes().data());
    } else if (is_data_uri(*b.uri)) {
        const std::optional<std::string_view> base64 = base64_of_uri(*b.uri);
        std::optional<std::string> decoded = base64 ? decode_base64(*base64) : std::nullopt;
        if (!decoded) doc_.fail(element, "the data URI is not base64");
        b.decoded = std::move(*decoded);
    } else {
        const FileFinder::Found found = find(*b.uri);
        if (!found.problem.empty()) doc_.fail(element, "file " + in_quotes(*b.uri) + " " + found.problem);
        if (found.path.empty())
            doc_.fail(element, "file " + in_quotes(*b.uri) + " not found", ErrorKind::missing_input);
        b.content = std::make_unique<FileContent>(found.path);
        if (!b.content->problem().empty())
            doc_.fail(element, "file " + in_quotes(*b.uri) + ": " + b.content->problem());
        b.bytes = b.content->bytes();
        b.file = found.path;
        files_.push_back(found.path);
        const uint64_t own = b.content->hash();
        hash_ = hash_bytes({reinterpret_cast<const char*>(&own), sizeof own}, hash_);
    }
    const size_t has = b.decoded.empty() ? b.bytes.size() : b.decoded.size();
    if (*length > has)
        doc_.fail(element,
                  "there are " + std::to_string(has) + " bytes, and 'byteLength' is " + std::to_string(*length));
    return b;
}

const GltfBuffers::Buffer& GltfBuffers::buffer(const JsonValue& element)
{
    const size_t number = doc_.number_of(element, "buffers");
    const auto known = buffers_.find(number);
    if (known != buffers_.end()) return known->second;
    Buffer& b = buffers_[number] = read(element);
    if (!b.decoded.empty()) b.bytes = b.decoded;  // where they stay
    b.bytes = b.bytes.substr(0, static_cast<size_t>(*doc_.whole(element, "byteLength")));
    return b;
}

std::string_view GltfBuffers::bytes_of(const JsonValue& of)
{
    const JsonValue* const element = doc_.refer(of, "buffer", "buffers");
    const std::optional<uint64_t> length = doc_.whole(of, "byteLength");
    if (!element || !length) doc_.fail(of, "there is no 'buffer' or no 'byteLength'");
    const uint64_t offset = doc_.whole(of, "byteOffset").value_or(0);
    const Buffer& b = buffer(*element);
    if (offset > b.bytes.size() || *length > b.bytes.size() - offset)
        doc_.fail(of, std::to_string(*length) + " bytes from byte " + std::to_string(offset) +
                          " on are not within the buffer, which has " + std::to_string(b.bytes.size()));
    return b.bytes.substr(static_cast<size_t>(offset), static_cast<size_t>(*length));
}

GltfBuffers::View GltfBuffers::view(const JsonValue& v)
{
    const std::optional<uint64_t> stride = doc_.whole(v, "byteStride");
    const JsonValue* const compressed = doc_.extension(v, "EXT_meshopt_compression");
    if (!compressed) return {bytes_of(v), stride};
    const auto [entry, is_new] = decoded_views_.try_emplace(doc_.number_of(v, "bufferViews"));
    if (is_new) entry->second = decode_meshopt(*compressed, bytes_of(*compressed), doc_);
    return {{entry->second.data(), entry->second.size()}, stride};
}

// Where the base64 of a data URI stands in the file: as it is, or with a backslash before each slash.
std::optional<FilePart> GltfBuffers::find_base64(std::string_view text, const std::string& label) const
{
    const std::string_view all = doc_.content().bytes();
    size_t at = all.find(text), size = text.size();
    if (at == std::string_view::npos) {
        const std::string escaped = with_escaped_slashes(text);
        at = all.find(escaped), size = escaped.size();
    }
    if (at == std::string_view::npos) return {};
    return FilePart{doc_.path(), label, at, size};
}

std::optional<FilePart> GltfBuffers::part_of_uri(const std::string& uri, const std::string& label) const
{
    const std::optional<std::string_view> base64 = base64_of_uri(uri);
    std::optional<FilePart> part = base64 && !base64->empty() ? find_base64(*base64, label) : std::nullopt;
    if (part) part->decoded = FilePart::Range{0, decoded_size(*base64)};
    return part;
}

std::optional<FilePart> GltfBuffers::part_of(const JsonValue& v, const std::string& label)
{
    const std::string_view bytes = bytes_of(v);
    const Buffer& b = buffer(*doc_.refer(v, "buffer", "buffers"));
    const auto offset = static_cast<uint64_t>(bytes.data() - b.bytes.data());
    if (!b.file.empty()) return FilePart{b.file, label, b.begin + offset, bytes.size()};
    const std::string_view base64 = *base64_of_uri(*b.uri);
    std::optional<FilePart> part = find_base64(base64, label);
    if (!part) return {};
    if (part->size != base64.size()) {
        part->decoded = FilePart::Range{offset, bytes.size()};
        return part;
    }
    // Four characters are three bytes: those around the part are enough.
    const uint64_t first = offset / 3, last = (offset + bytes.size() + 2) / 3;
    part->begin += 4 * first;
    part->size = std::min(4 * last, uint64_t{base64.size()}) - 4 * first;
    part->decoded = FilePart::Range{offset - 3 * first, bytes.size()};
    return part;
}

uint64_t GltfBuffers::size() const
{
    uint64_t sum = doc_.content().bytes().size();
    for (const auto& [number, b] : buffers_) sum += b.bytes.size();
    for (const auto& [number, bytes] : decoded_views_) sum += bytes.size();
    return sum;
}

}  // namespace lancer
