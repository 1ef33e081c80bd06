#include "io/file_part.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <string_view>

#include "io/base64.h"
#include "io/input_file.h"

namespace lancer {
namespace {

std::string text_of(uint64_t begin, uint64_t size) { return std::to_string(begin) + "+" + std::to_string(size); }

// "BEGIN+SIZE" and nothing else.
std::optional<FilePart::Range> range_of(std::string_view text)
{
    const size_t plus = text.find('+');
    if (plus == std::string_view::npos) return {};
    const auto number = [](std::string_view digits) -> std::optional<uint64_t> {
        uint64_t value = 0;
        const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (problem != std::errc() || end != digits.data() + digits.size()) return {};
        return value;
    };
    const auto begin = number(text.substr(0, plus)), size = number(text.substr(plus + 1));
    if (!begin || !size) return {};
    return FilePart::Range{*begin, *size};
}

}  // namespace

std::string name_of(const FilePart& part)
{
    std::string name = part.file + "#" + part.label + "@" + text_of(part.begin, part.size);
    if (part.decoded) name += "~" + text_of(part.decoded->begin, part.decoded->size);
    return name;
}

std::optional<FilePart> part_of_name(const std::string& name)
{
    const size_t hash = name.rfind('#');
    if (hash == std::string::npos || hash == 0) return {};
    const size_t at = name.find('@', hash), tilde = name.find('~', hash);
    if (at == std::string::npos || (tilde != std::string::npos && tilde < at)) return {};
    FilePart part{.file = name.substr(0, hash), .label = name.substr(hash + 1, at - hash - 1)};
    if (!std::all_of(part.label.begin(), part.label.end(), [](unsigned char c) { return std::isalnum(c); })) return {};
    const std::string_view rest(name);
    const auto range = range_of(rest.substr(at + 1, tilde == std::string::npos ? tilde : tilde - at - 1));
    if (!range) return {};
    part.begin = range->begin, part.size = range->size;
    if (tilde != std::string::npos && !(part.decoded = range_of(rest.substr(tilde + 1)))) return {};
    std::error_code unknown;
    if (std::filesystem::exists(name, unknown)) return {};
    return part;
}

std::string read_part(const FilePart& part)
{
    const auto invalid = [&](const std::string& message) {
        return Error(ErrorKind::invalid_input, {name_of(part)}, message);
    };
    InputFile file(part.file);
    if (part.begin > file.size() || part.size > file.size() - part.begin) throw invalid("the file ends too early");
    std::string bytes(part.size, '\0');
    file.seek(part.begin);
    if (file.read(bytes.data(), bytes.size()) != bytes.size()) throw invalid("the file ends too early");
    if (!part.decoded) return bytes;
    const std::optional<std::string> decoded = decode_base64(bytes);
    if (!decoded) throw invalid("is not base64");
    const auto [begin, size] = *part.decoded;
    if (begin > decoded->size() || size > decoded->size() - begin) throw invalid("the base64 ends too early");
    return decoded->substr(begin, size);
}

}  // namespace lancer
