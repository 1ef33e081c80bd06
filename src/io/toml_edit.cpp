#include "io/toml_edit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "io/toml_file.h"
#include "io/toml_write.h"

namespace lancer {
namespace {

using Table = TomlValue::Table;
using Array = TomlValue::Array;

std::optional<double> number_in(const TomlValue& value)
{
    if (const auto* whole = std::get_if<int64_t>(&value.data)) return static_cast<double>(*whole);
    if (const auto* x = std::get_if<double>(&value.data)) return *x;
    return {};
}

// Keys may stand in any order, and 1 is 1.0.
bool says_the_same(const TomlValue& a, const TomlValue& b)
{
    if (const auto x = number_in(a), y = number_in(b); x && y) return *x == *y || (std::isnan(*x) && std::isnan(*y));
    if (a.data.index() != b.data.index()) return false;
    if (const auto* tables = std::get_if<Table>(&a.data)) {
        const auto& others = std::get<Table>(b.data);
        return tables->size() == others.size() && std::all_of(tables->begin(), tables->end(), [&](const TomlEntry& e) {
                   const TomlValue* other = value_at(others, e.key);
                   return other && says_the_same(e.value, *other);
               });
    }
    if (const auto* array = std::get_if<Array>(&a.data))
        return std::equal(array->begin(), array->end(), std::get<Array>(b.data).begin(), std::get<Array>(b.data).end(),
                          says_the_same);
    if (const auto* text = std::get_if<std::string>(&a.data)) return *text == std::get<std::string>(b.data);
    if (const auto* flag = std::get_if<bool>(&a.data)) return *flag == std::get<bool>(b.data);
    return false;  // dates: no key takes one
}

// Finds what has to be said otherwise, and where.
class TomlEditor {
public:
    explicit TomlEditor(const std::string& text) : text_(text)
    {
        for (size_t i = 0; i < text.size(); ++i)
            if (text[i] == '\n') lines_.push_back(i + 1);
    }
    void edit(const TomlValue& from, const TomlValue& to)
    {
        edit_table(std::get<Table>(from.data), std::get<Table>(to.data), "", 0);
    }
    std::string edited() const
    {
        std::vector<Edit> edits = edits_;
        std::stable_sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return a.begin < b.begin; });
        std::string out;
        size_t done = 0;
        for (const Edit& e : edits) {
            if (e.begin < done) continue;  // what is read back tells
            out += text_.substr(done, e.begin - done) + e.text;
            done = e.end;
        }
        out += text_.substr(done);
        if (!last_.empty() && !out.empty() && out.back() != '\n') out += '\n';
        return out + last_;
    }

private:
    struct Edit {
        size_t begin, end;  // bytes of the text that go
        std::string text;   // what comes in their place
    };

    // Columns count characters of UTF-8.
    size_t offset(uint32_t line, uint32_t column) const
    {
        if (line == 0 || line > lines_.size()) return text_.size();
        size_t at = lines_[line - 1];
        const auto continues = [&] {
            return at < text_.size() && (static_cast<unsigned char>(text_[at]) & 0xc0) == 0x80;
        };
        for (uint32_t i = 1; i < column && at < text_.size(); ++i) {
            ++at;
            while (continues()) ++at;
        }
        return at;
    }
    size_t begin_of(const TomlValue& value) const { return offset(value.line, value.column); }
    size_t end_of(const TomlValue& value) const { return offset(value.end_line, value.end_column); }
    size_t after_line_of(size_t at) const
    {
        const size_t end = text_.find('\n', at);
        return end == text_.npos ? text_.size() : end + 1;
    }
    bool has_header(const TomlValue& value) const
    {
        const size_t at = begin_of(value);
        return std::holds_alternative<Table>(value.data) && at < text_.size() && text_[at] == '[';
    }
    bool is_list_with_headers(const TomlValue& value) const
    {
        const auto* array = std::get_if<Array>(&value.data);
        return array && !array->empty() &&
               std::all_of(array->begin(), array->end(), [&](const TomlValue& v) { return has_header(v); });
    }

    // path: of a table with a name, or of the list that has it, whose header comes again and again. header: where its
    // own one begins; of the root 0.
    void edit_table(const Table& from, const Table& to, const std::string& path, size_t header, bool is_of_list = false)
    {
        // Where a new key goes: behind the last one that is no table with a header.
        size_t behind = path.empty() ? 0 : after_line_of(header);
        for (const TomlEntry& e : from) {
            const bool is_line = !has_header(e.value) && !is_list_with_headers(e.value);
            if (is_line) behind = std::max(behind, after_line_of(end_of(e.value)));
            if (const TomlValue* now = value_at(to, e.key))
                edit_value(e.value, *now, path_of(path, e.key));
            else if (is_line)
                edits_.push_back({offset(e.line, 1), after_line_of(end_of(e.value)), ""});
        }
        // Only a table below it has a header: [a.b] without [a].
        const bool has_own = path.empty() || std::none_of(from.begin(), from.end(), [&](const TomlEntry& e) {
                                 return has_header(e.value) && begin_of(e.value) == header;
                             });
        Table lines, tables;
        for (const TomlEntry& e : to) {
            if (value_at(from, e.key)) continue;
            const bool is_table = std::holds_alternative<Table>(e.value.data);
            (!is_of_list && (is_table || is_list_of_tables(e.value)) ? tables : lines).push_back(e);
        }
        if (has_own && !lines.empty()) {
            const bool is_open = behind == text_.size() && !text_.empty() && text_.back() != '\n';
            edits_.push_back({behind, behind, (is_open ? "\n" : "") + lines_text(lines)});
        } else if (!lines.empty()) {
            last_ += "\n[" + path + "]\n" + lines_text(lines);
        }
        if (!tables.empty()) last_ += to_toml_text({.data = tables}, path);
    }

    void edit_value(const TomlValue& from, const TomlValue& to, const std::string& path)
    {
        if (says_the_same(from, to)) return;
        if (has_header(from) && std::holds_alternative<Table>(to.data))
            return edit_table(std::get<Table>(from.data), std::get<Table>(to.data), path, begin_of(from));
        if (is_list_with_headers(from) && is_list_of_tables(to))
            return edit_list(std::get<Array>(from.data), std::get<Array>(to.data), path);
        edits_.push_back({begin_of(from), end_of(from), to_toml_value(to)});
    }

    // New ones come before all others, where those stay as they are, else behind them.
    void edit_list(const Array& from, const Array& to, const std::string& path)
    {
        if (to.size() < from.size()) return;
        const auto more = static_cast<std::ptrdiff_t>(to.size() - from.size());
        if (std::equal(from.begin(), from.end(), to.begin() + more, says_the_same)) {
            const size_t at = begin_of(from.front());
            const Array added(to.begin(), to.begin() + more);
            edits_.push_back({at, at, list_text(path, added) + "\n"});
            return;
        }
        for (size_t i = 0; i < from.size(); ++i)
            edit_table(std::get<Table>(from[i].data), std::get<Table>(to[i].data), path, begin_of(from[i]), true);
        if (more > 0) last_ += "\n" + list_text(path, {to.end() - more, to.end()});
    }
    static std::string lines_text(const Table& table)
    {
        std::string text;
        for (const TomlEntry& e : table) text += to_toml_key(e.key) + " = " + to_toml_value(e.value) + "\n";
        return text;
    }
    static std::string list_text(const std::string& path, const Array& tables)
    {
        std::string text;
        for (const TomlValue& table : tables)
            text += (text.empty() ? "[[" : "\n[[") + path + "]]\n" + lines_text(std::get<Table>(table.data));
        return text;
    }
    static std::string path_of(const std::string& path, const std::string& key)
    {
        return (path.empty() ? "" : path + ".") + to_toml_key(key);
    }

    const std::string& text_;
    std::vector<size_t> lines_{0};  // where each begins
    std::vector<Edit> edits_;
    std::string last_;  // what comes behind all of the text
};

std::optional<TomlValue> read(const std::string& text)
{
    Diagnostics none;
    return parse_toml(text, "", none);
}

}  // namespace

std::optional<std::string> edited_toml_text(const std::string& text, const TomlValue& root)
{
    const std::optional<TomlValue> before = read(text);
    if (!before) return {};
    TomlEditor editor(text);
    editor.edit(*before, root);
    std::string edited = editor.edited();
    const std::optional<TomlValue> after = read(edited);
    if (!after || !says_the_same(*after, root)) return {};
    return edited;
}

}  // namespace lancer
