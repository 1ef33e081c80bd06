#include "io/mtl_scan.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>

#include "core/names.h"
#include "io/text_file.h"

namespace lancer {
namespace {

namespace fs = std::filesystem;

// Three numbers, or one for all three. Anything else (spectral files, CIE XYZ, words) is not supported.
std::optional<std::string> color_values(std::string_view arguments)
{
    std::array<std::string_view, 3> words;
    size_t n = 0;
    for (std::string_view word = take_word(arguments); !word.empty() && word[0] != '#'; word = take_word(arguments)) {
        if (n == 3) return {};
        word = word.substr(0, word.find('#'));
        if (classify_number(word) != NumberKind::finite) return {};
        words[n++] = word;
    }
    if (n == 1) words[1] = words[2] = words[0];
    if (n != 1 && n != 3) return {};
    return std::string(words[0]).append(" ").append(words[1]).append(" ").append(words[2]);
}

std::string lower(std::string s)
{
    for (char& c : s)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
    return s;
}

bool is_file(const fs::path& path)
{
    std::error_code error;
    return fs::is_regular_file(path, error);
}

// The path itself, or the one of the same folder that differs in case only.
std::optional<fs::path> find_file(const fs::path& path, bool& other_case)
{
    if (is_file(path)) return path;
    std::error_code error;
    const std::string wanted = lower(path.filename().string());
    std::optional<fs::path> best;  // the first by name: folders are listed in any order
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    for (fs::directory_iterator i(folder, error), end; !error && i != end; i.increment(error))
        if (lower(i->path().filename().string()) == wanted && is_file(i->path()) && (!best || i->path() < *best))
            best = i->path();
    other_case = best.has_value();
    return best;
}

class LibraryFinder {
public:
    LibraryFinder(const std::string& obj_file, Diagnostics& diagnostics)
        : obj_file_(obj_file), folder_(fs::path(obj_file).parent_path()), diagnostics_(diagnostics)
    {
    }

    void add(const ObjSummary::Name& library)
    {
        std::string names = library.name;
        std::replace(names.begin(), names.end(), '\\', '/');
        const Location where{obj_file_, library.line, 0};
        if (try_add(names, where)) return;
        std::vector<std::string> words;
        constexpr size_t most_words = 16;  // of one statement; every start and end among them is tried as a name
        std::string_view rest = names;
        for (std::string_view w = take_word(rest); !w.empty() && words.size() < most_words; w = take_word(rest))
            words.emplace_back(w);
        for (size_t begin = 0; begin < words.size();) {
            size_t end = words.size();
            while (end > begin && !(words.size() > 1 && try_add(join(words, begin, end), where))) --end;
            if (end == begin) {  // not found: up to the next word that looks like the end of a name
                while (end < words.size() && !lower(words[end]).ends_with(".mtl")) ++end;
                end = std::min(end + 1, words.size());
                warn_missing(join(words, begin, end), where);
            }
            begin = end;
        }
        if (words.empty()) diagnostics_.warning(where, "mtllib without a file name");
    }

    std::vector<std::string> take() { return std::move(files_); }

private:
    static std::string join(const std::vector<std::string>& words, size_t begin, size_t end)
    {
        std::string s = words[begin];
        for (size_t i = begin + 1; i < end; ++i) s += ' ' + words[i];
        return s;
    }

    bool try_add(const std::string& name, const Location& where)
    {
        if (name.empty()) return false;
        bool other_case = false;
        const auto found = find_file(folder_ / name, other_case);
        if (!found) return false;
        if (other_case)
            diagnostics_.warning(where, "material file " + in_quotes(name) + " not found; " +
                                            in_quotes(found->filename().string()) + " is used");
        if (std::find(files_.begin(), files_.end(), found->string()) == files_.end()) files_.push_back(found->string());
        return true;
    }

    void warn_missing(const std::string& name, const Location& where)
    {
        constexpr int most_named = 10;
        if (++missing_ <= most_named)
            diagnostics_.warning(where, "material file " + in_quotes(name) + " not found");
        else
            diagnostics_.warning(where, "other material files not found");
    }

    const std::string& obj_file_;
    fs::path folder_;
    Diagnostics& diagnostics_;
    std::vector<std::string> files_;
    uint64_t missing_ = 0;
};

}  // namespace

MtlScan scan_mtl(std::string_view text, const std::string& file, Diagnostics& diagnostics)
{
    MtlScan scan;
    uint32_t first_stray = 0;
    uint64_t strays = 0;
    TextLines lines(text);
    while (lines.next()) {
        std::string_view arguments = lines.line();
        const std::string_view key = take_word(arguments);
        const Location where{file, lines.number(), 0};
        if (key.empty() || key[0] == '#') continue;
        if (key == "newmtl") {
            scan.materials.push_back({std::string(name_argument(arguments)), lines.number(), scan.text.size()});
            scan.text += "newmtl " + std::to_string(scan.materials.size()) + '\n';
        } else if (scan.materials.empty()) {
            if (strays++ == 0) first_stray = lines.number();
        } else if (key == "Kd" || key == "Ke") {
            uint32_t& line = key == "Kd" ? scan.materials.back().kd_line : scan.materials.back().ke_line;
            if (const auto values = color_values(arguments)) {
                scan.text.append(key).append(" ").append(*values) += '\n';
                line = lines.number();
            } else {
                diagnostics.warning(where, std::string(key) + " is not three finite numbers; ignored");
            }
        }
    }
    if (strays) diagnostics.warning({file, first_stray, 0}, "statement before the first newmtl ignored", strays);
    return scan;
}

std::vector<std::string> find_material_files(const std::string& obj_file,
                                             const std::vector<ObjSummary::Name>& libraries, Diagnostics& diagnostics)
{
    LibraryFinder finder(obj_file, diagnostics);
    for (const ObjSummary::Name& library : libraries) finder.add(library);
    return finder.take();
}

}  // namespace lancer
