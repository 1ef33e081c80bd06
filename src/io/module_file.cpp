#include "io/module_file.h"

#include <filesystem>

namespace lancer {

void* open_module(const std::string& name, int32_t version, const std::string& missing)
{
    std::error_code unknown;
    const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
    std::string tried;
    for (const char* place : {"", "../", LANCER_INSTALLED_MODULES "/"}) {
        const std::string path = (folder / (place + name + ".so")).lexically_normal();
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
