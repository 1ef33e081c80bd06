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
    for (char& c : lower) c = to_lower(c);
    return lower;
}

namespace {

int digit_of(char c)
{
    if (c >= '0' && c <= '9') return c - '0';
    c = to_lower(c);
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

// The path of a URL of a file (RFC 8089), with %20 as a space; any other name as it is.
std::string path_of(const std::string& name)
{
    constexpr std::string_view scheme = "file:";
    if (!to_lower(name.substr(0, scheme.size())).starts_with(scheme)) return name;
    std::string path;
    for (size_t i = scheme.size(); i < name.size(); ++i) {
        const int high = i + 2 < name.size() ? digit_of(name[i + 1]) : -1,
                  low = i + 2 < name.size() ? digit_of(name[i + 2]) : -1;
        if (name[i] == '%' && high >= 0 && low >= 0) {
            path += static_cast<char>(16 * high + low);
            i += 2;
        } else {
            path += name[i];
        }
    }
    if (path.starts_with("//")) path.erase(0, std::min(path.find('/', 2), path.size()));  // the host
    return path;
}

}  // namespace

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
    const std::string path = path_of(name);
    Found found = find_at(path);
    if (!found.path.empty()) return found;
    const std::string bare = path.substr(path.rfind('/') + 1);
    if (bare.empty() || bare == "." || bare == "..") return found;
    for (const char* folder : {"", "textures/", "../textures/"}) {
        Found other = find_at(folder + bare);
        if (other.path.empty()) continue;
        other.other_folder = true;
        return other;
    }
    if (allowed_)
        if (const AssetFolder::Found asset = allowed_->find(bare); asset.problem.empty())
            return {.path = asset.path, .other_folder = true};
    return found;
}

FileFinder::Found FileFinder::find_at(const std::string& name)
{
    const fs::path path = (folder_ / name).lexically_normal();
    // Before anything is looked for: a message must not tell what there is in other folders.
    if (std::string problem = problem_of(path); !problem.empty()) return {.problem = std::move(problem)};
    if (is_there(path, true)) return {.path = path.string()};
    fs::path other = path.root_path();
    const fs::path relative = path.relative_path();
    for (auto part = relative.begin(); part != relative.end(); ++part)
        if (!step(other, part->string(), std::next(part) == relative.end())) return {};
    if (other.empty() || !is_there(other, true)) return {};
    if (std::string problem = problem_of(other); !problem.empty()) return {.problem = std::move(problem)};
    return {.path = other.string(), .other_case = true};
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
