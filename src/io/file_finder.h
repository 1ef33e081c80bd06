// Finds the files that a mesh or material file names: relative to its folder, in any mixture of upper and lower case,
// and only where the scene may read. A file that is not where its path says is sought by its bare name: paths of the
// machine where the file was written mean nothing elsewhere.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "io/asset_path.h"

namespace lancer {

class FileFinder {
public:
    struct Found {
        std::string path{};         // empty: there is none
        bool other_case = false;    // some letter of the name is written otherwise on disk
        bool other_folder = false;  // found by its bare name
        std::string problem{};      // if not empty: why the file may not be read
    };

    // file: the one that names others. allowed: null for no limit.
    FileFinder(const std::string& file, const AssetFolder* allowed);
    // Folders in the name are parted by '/'; it may be a URL of a file. Then its bare name: in the folder of the file
    // that names it, in textures/ there, in ../textures/, and in the root of the assets. Each folder is listed at most
    // once, and only if a name is not found as it is written.
    Found find(const std::string& name);

private:
    using Listing = std::set<std::pair<std::string, std::string>>;  // names in lower case, names

    Found find_at(const std::string& name);
    bool step(std::filesystem::path& path, const std::string& name, bool last);
    const Listing& listing(const std::filesystem::path& folder);
    std::string problem_of(const std::filesystem::path& path) const;

    std::filesystem::path folder_;
    const AssetFolder* allowed_;
    std::map<std::string, Listing> listings_;
};

// ASCII letters only.
constexpr char to_lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }
std::string to_lower(std::string_view s);

}  // namespace lancer
