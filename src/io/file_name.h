// What the name of a file says of its content.
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
inline bool is_mesh(const std::string& path)
{
    const std::string extension = extension_of(path);
    return extension == ".obj" || extension == ".ply";
}

}  // namespace lancer
