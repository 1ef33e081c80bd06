#include "io/file_finder.h"

#include <algorithm>

namespace lancer {
namespace fs = std::filesystem;

namespace {

bool is_there(const fs::path& path, bool as_file)
{
    std::error_code error;
    return as_file ? fs::is_regular_file(path, error) : fs::is_directory(path, error);
}

}  // namespace

std::string to_lower(std::string_view s)
{
    std::string lower(s);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
    return lower;
}

FileFinder::FileFinder(const std::string& file, const AssetFolder* allowed)
    : folder_(fs::path(file).parent_path()), allowed_(allowed)
{
}

std::string FileFinder::problem_of(const fs::path& path) const
{
    if (!allowed_) return {};
    const AssetFolder::Found found = allowed_->check(path);
    return found.kind == ErrorKind::missing_input ? std::string() : found.problem;
}

FileFinder::Found FileFinder::find(const std::string& name)
{
    const fs::path path = (folder_ / name).lexically_normal();
    // Before anything is looked for: a message must not tell what there is in other folders.
    if (std::string problem = problem_of(path); !problem.empty()) return {{}, false, std::move(problem)};
    if (is_there(path, true)) return {path.string(), false, {}};
    fs::path other = path.root_path();
    const fs::path relative = path.relative_path();
    for (auto part = relative.begin(); part != relative.end(); ++part)
        if (!step(other, part->string(), std::next(part) == relative.end())) return {};
    if (other.empty() || !is_there(other, true)) return {};
    if (std::string problem = problem_of(other); !problem.empty()) return {{}, false, std::move(problem)};
    return {other.string(), true, {}};
}

// Goes on to the file or folder of this name, or the first by name that differs in case only.
bool FileFinder::step(fs::path& path, const std::string& name, bool last)
{
    if (is_there(path / name, last)) {
        path /= name;
        return true;
    }
    const std::string lower = to_lower(name);
    const Listing& all = listing(path);
    for (auto i = all.lower_bound({lower, {}}); i != all.end() && i->first == lower; ++i) {
        if (!is_there(path / i->second, last)) continue;
        path /= i->second;
        return true;
    }
    return false;
}

const FileFinder::Listing& FileFinder::listing(const fs::path& folder)
{
    const auto [entry, fresh] = listings_.try_emplace(folder.string());
    if (!fresh) return entry->second;
    std::error_code error;
    for (fs::directory_iterator i(folder.empty() ? fs::path(".") : folder, error), end; !error && i != end;
         i.increment(error)) {
        const std::string name = i->path().filename().string();
        entry->second.emplace(to_lower(name), name);
    }
    return entry->second;
}

}  // namespace lancer
