// Finds the files a scene names. A scene may only read what lies in its own folder, or in the asset root if the user
// gives one, so that a scene from elsewhere cannot reach the rest of the disk.
#pragma once

#include <filesystem>
#include <string>

#include "core/error.h"

namespace lancer {

class AssetFolder {
public:
    struct Found {
        std::string path = {};      // as messages show it: with the folder of the scene as the user gave it
        std::string identity = {};  // the same for every spelling of one file
        std::string problem = {};   // if not empty: why the file cannot be had
        ErrorKind kind = ErrorKind::invalid_input;
    };

    // Without a root, the folder of the scene is the root. Throws Error if the root is not a folder.
    AssetFolder(const std::string& scene_file, const std::string& asset_root);

    // A file in the scene's folder that the user himself has named: it may be a link that leads out of it.
    void admit(const std::string& name) { admitted_ = name; }

    // A relative name is sought in the scene's folder, then in the root.
    Found find(const std::string& name) const;
    // The same for a path that is complete already, absolute or relative to the working folder.
    Found check(const std::filesystem::path& path) const;

private:
    std::filesystem::path folder_, root_;  // as given
    std::filesystem::path real_root_;      // absolute, without links
    std::string admitted_;
};

}  // namespace lancer
