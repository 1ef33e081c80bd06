#include "io/input_text.h"

#include <algorithm>
#include <utility>

#include "io/file_content.h"

namespace lancer {
namespace {

// The first place behind the quoted text that starts at `i`. Ends early at the end of the line or of the text, where
// the parser will complain.
size_t skip_quoted(std::string_view text, size_t i)
{
    const char quote = text[i];
    const std::string three(3, quote);
    const bool is_long = text.substr(i, 3) == three;
    for (i += is_long ? 3 : 1; i < text.size(); ++i) {
        if (quote == '"' && text[i] == '\\') {
            ++i;
        } else if (is_long && text.substr(i, 3) == three) {
            i += 3;
            while (i < text.size() && text[i] == quote) ++i;  // up to two quotes may stand before the closing three
            return i;
        } else if (!is_long && (text[i] == quote || text[i] == '\n')) {
            return text[i] == quote ? i + 1 : i;
        }
    }
    return text.size();
}

// The line of the first dotted key with too many parts, else 0.
uint32_t line_of_too_deep_key(std::string_view text)
{
    uint32_t line = 1;
    size_t dots = 0;
    for (size_t i = 0; i < text.size();) {
        const char c = text[i];
        if (c == '"' || c == '\'') {
            const size_t end = skip_quoted(text, i);
            line += static_cast<uint32_t>(std::count(text.data() + i, text.data() + end, '\n'));
            i = end;
            continue;
        }
        if (c == '#') {
            i = std::min(text.find('\n', i), text.size());
            continue;
        }
        if (c == '\n') ++line;
        if (c == '\n' || c == '=' || c == ',' || c == '[' || c == '{') dots = 0;
        if (c == '.' && ++dots >= most_key_parts) return line;
        ++i;
    }
    return 0;
}

}  // namespace

std::string read_input_text(const std::string& path)
{
    const FileContent content(path);
    if (!content.problem().empty())
        throw Error(content.missing() ? ErrorKind::missing_input : ErrorKind::invalid_input, {path}, content.problem());
    return std::string(content.bytes());
}

bool check_toml_text(std::string_view text, const std::string& path, Diagnostics& diagnostics)
{
    const std::string_view mark = "\xEF\xBB\xBF";  // some editors put it before UTF-8
    const std::string_view visible = text.substr(text.starts_with(mark) ? mark.size() : 0);
    if (visible.find_first_not_of(" \t\r\n") == std::string_view::npos) {
        diagnostics.error({path}, "the file is empty");
        return false;
    }
    if (text.find('\0') != std::string_view::npos) {
        diagnostics.error({path}, "is not a text file: it holds a zero byte");
        return false;
    }
    if (const uint32_t line = line_of_too_deep_key(text)) {
        diagnostics.error({path, line}, "a key with more than " + std::to_string(most_key_parts) + " parts");
        return false;
    }
    return true;
}

}  // namespace lancer
