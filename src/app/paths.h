// File names.
#pragma once

#include <cctype>
#include <filesystem>
#include <string>

namespace lancer {

// ".exr" of "a.EXR"; empty if there is none.
inline std::string extension_of(const std::string& path)
{
    std::string extension = std::filesystem::path(path).extension();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

// Whether it is a bare mesh, not a scene file.
inline bool is_mesh(const std::string& path) { return extension_of(path) == ".obj"; }
inline bool is_scene(const std::string& path) { return is_mesh(path) || extension_of(path) == ".toml"; }

}  // namespace lancer
