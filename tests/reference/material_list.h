// From what a scene file says of materials to the numbered list of a World.
#pragma once

#include <map>

#include "reference/world.h"

namespace reference {

class MaterialList {
public:
    MaterialList(World& world, const lancer::SceneDescription& description, const lancer::RasterSource& images)
        : world_(world), d_(description), images_(images)
    {
    }
    size_t add(const lancer::MaterialDescription& m);
    // A [material.NAME], a preset, or the grey of what has none.
    size_t named(const std::string& name);
    // Of a mesh file, under the overrides.
    size_t of_file(const lancer::MaterialDescription& m);
    size_t inside_out(const std::string& name);
    size_t banded(const std::string& name, const lancer::Bands& bands, lancer::TextureType pattern);
    size_t water(const lancer::PlaneDescription& plane);

private:
    lancer::MaterialDescription described(const std::string& name) const;
    const Texture* texture(const lancer::TextureUse& use);

    World& world_;
    const lancer::SceneDescription& d_;
    const lancer::RasterSource& images_;
    std::map<std::string, size_t> named_;
};

}  // namespace reference
