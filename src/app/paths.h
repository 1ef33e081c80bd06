// File names.
#pragma once

#include <optional>
#include <string>

#include "io/file_name.h"
#include "io/image/picture_format.h"

namespace lancer {

// The format of a picture, by the end of its name; nothing where that says none.
inline std::optional<PictureFormat> format_of(const std::string& path)
{
    const std::string extension = extension_of(path);
    if (extension == ".jpeg") return PictureFormat::jpg;
    for (size_t i = 0; i < enum_names<PictureFormat>.size(); ++i)
        if (extension == "." + std::string(enum_names<PictureFormat>[i])) return static_cast<PictureFormat>(i);
    return {};
}

// The same of an output, whose format is given where its name says none.
inline PictureFormat format_of(const std::string& path, std::optional<PictureFormat> given)
{
    return format_of(path).value_or(given.value_or(PictureFormat::exr));
}

// What "-o -" stands for.
inline constexpr const char* standard_output = "/dev/stdout";

inline bool is_scene(const std::string& path) { return is_mesh(path) || extension_of(path) == ".toml"; }

}  // namespace lancer
