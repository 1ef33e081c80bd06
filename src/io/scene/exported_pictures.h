// The pictures that an exported scene needs beside its meshes. Each holds the numbers that materials are made of,
// decoded and with channel, gain and bias applied, so that who reads them need not know how a file stored them.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace lancer {

struct ExportedPicture {
    std::string name;  // of its file
    uint32_t width = 0, height = 0;
    bool half = false;                                     // 16-bit floats are enough
    std::function<Color(uint32_t x, uint32_t y)> texel{};  // x from the left, y from the top
};

struct ExportedPictures {
    std::vector<ExportedPicture> files;
    // Textures that a parameter of a material has, with their place in "textures" of scene.json.
    std::map<uint32_t, size_t> textures;
    // By material, else empty: normals in tangent space of its bumps, with the texture transform of the bump texture;
    // the light that the coat of a plastic lets through; what a rough sheet of glass reflects and lets through over
    // what a smooth one does.
    std::vector<std::string> bumps, coats, sheets;
    std::string environment;  // empty: it is no picture

    // The file of an image texture.
    static std::string file_of_texture(uint32_t texture);
};

// scene: complete; must outlive what is returned.
ExportedPictures exported_pictures(const Scene& scene);

}  // namespace lancer
