// The material files of an OBJ file and their materials.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "io/mtl/material.h"
#include "io/obj/scan.h"

namespace lancer {

// What mtllib statements name.
struct MaterialFiles {
    struct Missing {
        Location where;
        std::string name, problem;  // "not found", or why it may not be read
    };
    std::vector<std::string> found;  // each once
    std::vector<Missing> missing;    // each once; not warned about yet, as their materials have the same cause
};

// Relative to the OBJ file. A name may contain spaces, be one of several, or differ in upper and lower case. Files
// outside of `assets` are missing.
MaterialFiles find_material_files(const std::string& obj_file, const std::vector<ObjSummary::Name>& libraries,
                                  const AssetFolder* assets, Diagnostics& diagnostics);

class MaterialLibrary {
public:
    // Of materials with the same name the first one is used.
    void add_file(const std::string& path, std::string_view text, const AssetFolder* assets, Diagnostics& diagnostics);
    // The description of a material with its texture files; nothing if no file defines it.
    std::optional<MaterialDescription> describe(const std::string& name, Diagnostics& diagnostics);

private:
    struct Place {
        size_t file, entry;
    };
    struct Content {
        MtlFile file;
        std::vector<MtlEntry> entries;
    };
    std::deque<Content> files_;
    std::unordered_map<std::string, Place> index_, without_comment_;  // by name
};

}  // namespace lancer
