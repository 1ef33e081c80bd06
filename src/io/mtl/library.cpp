#include "io/mtl/library.h"

#include <algorithm>
#include <set>

#include "core/names.h"
#include "io/text_file.h"

namespace lancer {
namespace {

class LibraryFinder {
public:
    LibraryFinder(const std::string& obj_file, const AssetFolder* assets, Diagnostics& diagnostics)
        : obj_file_(obj_file), finder_(obj_file, assets), diagnostics_(diagnostics)
    {
    }

    void add(const ObjSummary::Name& library)
    {
        std::string names = library.name;
        std::replace(names.begin(), names.end(), '\\', '/');
        const Location where{obj_file_, library.line, 0};
        if (try_add(names, where)) return;
        if (const std::string without_comment(name_argument(names)); without_comment != names) {
            names = without_comment;
            if (try_add(names, where)) return;
        }
        std::vector<std::string> words;
        constexpr size_t most_words = 16;  // of one statement; every start and end among them is tried as a name
        std::string_view rest = names;
        for (std::string_view w = take_word(rest); !w.empty() && words.size() < most_words; w = take_word(rest))
            words.emplace_back(w);
        for (size_t begin = 0; begin < words.size();) {
            size_t end = words.size();
            while (end > begin && !(words.size() > 1 && try_add(join(words, begin, end), where))) --end;
            if (end == begin) {  // not found: up to the next word that looks like the end of a name
                while (end < words.size() && !to_lower(words[end]).ends_with(".mtl")) ++end;
                end = std::min(end + 1, words.size());
                add_missing(join(words, begin, end), where, "not found");
            }
            begin = end;
        }
        if (words.empty()) diagnostics_.warning(where, "mtllib without a file name");
    }

    MaterialFiles take() { return std::move(files_); }

private:
    static std::string join(const std::vector<std::string>& words, size_t begin, size_t end)
    {
        std::string s = words[begin];
        for (size_t i = begin + 1; i < end; ++i) s += ' ' + words[i];
        return s;
    }

    // True as well for a file that may not be read: there is nothing else to look for.
    bool try_add(const std::string& name, const Location& where)
    {
        if (name.empty()) return false;
        const FileFinder::Found found = finder_.find(name);
        if (!found.problem.empty()) add_missing(name, where, found.problem);
        if (found.path.empty()) return !found.problem.empty();
        const NamedProblem elsewhere{"material file", name, " not found; that name in another folder is used"};
        const NamedProblem other_case{"material file", name, " not found; that name in other letters is used"};
        if (found.other_folder || found.other_case)
            diagnostics_.warning(where, found.other_folder ? elsewhere : other_case);
        if (std::find(files_.found.begin(), files_.found.end(), found.path) == files_.found.end())
            files_.found.push_back(found.path);
        return true;
    }

    void add_missing(const std::string& name, const Location& where, const std::string& problem)
    {
        if (missing_.insert(name).second) files_.missing.push_back({where, name, problem});
    }

    const std::string& obj_file_;
    FileFinder finder_;
    Diagnostics& diagnostics_;
    MaterialFiles files_;
    std::set<std::string> missing_;
};

}  // namespace

MaterialFiles find_material_files(const std::string& obj_file, const std::vector<ObjSummary::Name>& libraries,
                                  const AssetFolder* assets, Diagnostics& diagnostics)
{
    LibraryFinder finder(obj_file, assets, diagnostics);
    for (const ObjSummary::Name& library : libraries) finder.add(library);
    return finder.take();
}

void MaterialLibrary::add_file(const std::string& path, std::string_view text, const AssetFolder* assets,
                               Diagnostics& diagnostics)
{
    files_.push_back({{path, FileFinder(path, assets)}, scan_mtl(text, path, diagnostics)});
    const std::vector<MtlEntry>& entries = files_.back().entries;
    for (size_t i = 0; i < entries.size(); ++i) {
        const Place place{files_.size() - 1, i};
        if (!index_.try_emplace(entries[i].name, place).second)
            diagnostics.warning({path, entries[i].line, 0},
                                NamedProblem{"material", entries[i].name, " exists already; the first is used"});
        without_comment_.try_emplace(std::string(name_argument(entries[i].name)), place);
    }
}

// A '#' belongs to a name where both files have it there. Otherwise it begins a comment.
std::optional<MaterialDescription> MaterialLibrary::describe(const std::string& name, Diagnostics& diagnostics)
{
    const auto describe_at = [&](const Place& place) {
        Content& content = files_[place.file];
        return describe_mtl(content.entries[place.entry], content.file, diagnostics);
    };
    if (const auto found = index_.find(name); found != index_.end()) return describe_at(found->second);
    const auto found = without_comment_.find(std::string(name_argument(name)));
    if (found == without_comment_.end()) return {};
    MaterialDescription m = describe_at(found->second);
    m.name = found->first;
    return m;
}

}  // namespace lancer
