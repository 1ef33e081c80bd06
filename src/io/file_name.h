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

// ".ply" of "a.ply" and "a.ply.gz"; of other names as extension_of().
inline std::string mesh_extension_of(const std::string& path)
{
    const std::string extension = extension_of(path);
    if (extension != ".gz" && extension != ".xz" && extension != ".zst") return extension;
    return extension_of(std::filesystem::path(path).stem());
}

inline bool is_gltf(const std::string& path)
{
    const std::string extension = extension_of(path);
    return extension == ".gltf" || extension == ".glb";
}

// Whether it is a bare mesh, not a scene file.
inline bool is_mesh(const std::string& path)
{
    const std::string extension = mesh_extension_of(path);
    return extension == ".obj" || extension == ".ply" || is_gltf(path);
}

// "a" of "b/a.toml" and of "b/a.ply.gz": what is made of a scene is named so.
inline std::string scene_name_of(const std::string& path)
{
    const std::filesystem::path stem = std::filesystem::path(path).stem();
    return is_mesh(path) && mesh_extension_of(path) != extension_of(path) ? stem.stem().string() : stem.string();
}

}  // namespace lancer
