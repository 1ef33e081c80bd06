#include "io/module_file.h"

#include <filesystem>
#include <vector>

namespace lancer {

namespace {

// Where modules may be: beside the program or library that this is a part of, or where they are installed.
std::vector<std::filesystem::path> module_folders()
{
    std::error_code unknown;
    Dl_info part = {};
    const bool is_known = dladdr(reinterpret_cast<const void*>(&open_module), &part) != 0 && part.dli_fname;
    const std::filesystem::path object = is_known ? part.dli_fname : "";
    if (object.filename().string().starts_with("liblancer.so")) {
        const std::filesystem::path folder = std::filesystem::canonical(object, unknown).parent_path();
        return {folder, folder / "lancer"};
    }
    const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
    return {folder, folder / "..", folder / LANCER_INSTALLED_MODULES};
}

}  // namespace

void* open_module(const std::string& name, int32_t version, const std::string& missing)
{
    std::error_code unknown;
    std::string tried;
    for (const std::filesystem::path& folder : module_folders()) {
        const std::string path = (folder / (name + ".so")).lexically_normal();
        tried += (tried.empty() ? "" : ", ") + path;
        if (!std::filesystem::exists(path, unknown)) continue;
        void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (!library)
            throw Error(ErrorKind::failed, {path},
                        "cannot be opened: " + std::string(dlerror()) +
                            "; a library that only this module needs may not be installed");
        int32_t (*version_of)() = nullptr;
        find_symbol(library, (name + "_version").c_str(), version_of);
        if (version_of() != version)
            throw Error(ErrorKind::failed, {path},
                        "is of another build of lancer; build the target " + name + " again");
        return library;
    }
    throw Error(ErrorKind::failed, "error: " + name + ".so, " + missing + ". Looked for: " + tried);
}

}  // namespace lancer
