#include "io/asset_path.h"

#include <algorithm>
#include <system_error>

#include "core/names.h"

namespace lancer {
namespace fs = std::filesystem;

namespace {

bool is_inside(const fs::path& path, const fs::path& folder)
{
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace

AssetFolder::AssetFolder(const std::string& scene_file, const std::string& asset_root)
    : folder_(fs::path(scene_file).parent_path()), root_(asset_root.empty() ? folder_ : fs::path(asset_root))
{
    std::error_code problem;
    real_root_ = fs::canonical(root_.empty() ? "." : root_, problem);
    if (!asset_root.empty() && (problem || !fs::is_directory(real_root_, problem))) {
        throw Error(ErrorKind::usage, {}, "the asset root " + in_quotes(asset_root) + " is not a folder");
    }
}

AssetFolder::Found AssetFolder::check(const fs::path& path) const
{
    Found found{.path = path.lexically_normal().string()};
    std::error_code problem;
    // Absolute first: of a relative path that does not exist, weakly_canonical would leave a relative one.
    const fs::path real = fs::weakly_canonical(fs::absolute(path, problem), problem);
    if (problem) {
        found.problem = "cannot be found: " + problem.message();
        found.kind = ErrorKind::missing_input;
        return found;
    }
    found.identity = real.string();
    if (!is_inside(real, real_root_)) {
        found.problem = "lies outside of the folder of the scene; --asset-root FOLDER allows another folder";
        if (root_ != folder_) found.problem = "lies outside of the --asset-root " + in_quotes(root_.string());
        return found;
    }
    const fs::file_status status = fs::status(real, problem);
    if (!fs::exists(status)) {
        found.problem = "does not exist";
        found.kind = ErrorKind::missing_input;
    } else if (!fs::is_regular_file(status)) {
        found.problem = fs::is_directory(status) ? "is a folder, not a file" : "is not a file";
    }
    return found;
}

AssetFolder::Found AssetFolder::find(const std::string& name) const
{
    if (name.find('\0') != std::string::npos) return {.problem = "holds a zero byte"};
    if (!admitted_.empty() && name == admitted_) {
        const std::string path = (folder_ / name).string();
        return {.path = path, .identity = path};
    }
    const Found in_folder = check(folder_ / name);
    if (in_folder.problem.empty() || root_ == folder_) return in_folder;
    Found in_root = check(root_ / name);
    const bool is_only_missing = in_root.kind == ErrorKind::missing_input && in_folder.kind != ErrorKind::missing_input;
    std::error_code ignored;
    if (is_only_missing && fs::exists(folder_ / name, ignored))
        in_root.problem = "does not exist in the --asset-root " + in_quotes(root_.string()) +
                          "; the one in the folder of the scene lies outside of that";
    return in_root.problem.empty() || is_only_missing ? in_root : in_folder;
}

}  // namespace lancer
