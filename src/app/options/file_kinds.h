// Endings of the files that options take, separated by blanks: what completions offer. Readers judge for themselves.
#pragma once

#include <string_view>

namespace lancer::files {

inline constexpr std::string_view scenes =
    ".toml .obj .ply .gltf .glb .obj.gz .obj.xz .obj.zst .ply.gz .ply.xz .ply.zst";
inline constexpr std::string_view written_pictures = ".exr .png .ppm .jpg .jpeg .hdr";
inline constexpr std::string_view written_frames = ".exr .png .ppm .jpg .jpeg .hdr .mp4";
inline constexpr std::string_view merged = ".exr .png .ppm .jpg .jpeg .hdr .lancer";
inline constexpr std::string_view read_pictures =
    ".exr .png .jpg .jpeg .hdr .tga .tif .tiff .webp .dds .gif .bmp .ppm .pgm .pfm";
inline constexpr std::string_view scenes_and_pictures =
    ".toml .obj .ply .gltf .glb .exr .png .jpg .jpeg .hdr .tga .tif .tiff .webp .dds .gif .bmp .ppm .pgm .pfm";
inline constexpr std::string_view exr = ".exr";
inline constexpr std::string_view png = ".png";
inline constexpr std::string_view toml = ".toml";
inline constexpr std::string_view json = ".json";
inline constexpr std::string_view csv = ".csv";
inline constexpr std::string_view ocio = ".ocio .ocioz";
inline constexpr std::string_view checkpoints = ".lancer";

}  // namespace lancer::files
