// A folder of its own for each test, and a mesh loader that reads nothing.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "io/scene/scene_file.h"

namespace lancer {

class SceneFileTest : public testing::Test {
protected:
    SceneFileTest()
    {
        const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::temp_directory_path() /
                  ("lancer_" + std::string(test.name()) + "_" + std::to_string(getpid()));
        std::filesystem::create_directories(folder_);
        options_.mesh_loader = [this](const std::string& path, Diagnostics&, const MeshOptions&) {
            loaded_.push_back(without_folder(path));
            auto data = std::make_shared<MeshData>();
            data->file = path;
            return data;
        };
    }
    ~SceneFileTest() override { std::filesystem::remove_all(folder_); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    void write(const std::string& name, const std::string& text) const
    {
        std::filesystem::create_directories(std::filesystem::path(path(name)).parent_path());
        std::ofstream(path(name), std::ios::binary) << text;
    }
    std::string without_folder(std::string text) const
    {
        const std::string prefix = folder_.string() + "/";
        for (size_t i; (i = text.find(prefix)) != std::string::npos;) text.erase(i, prefix.size());
        return text;
    }

    // The scene of a text that must be right.
    SceneDescription scene(const std::string& text) const
    {
        Diagnostics diagnostics;
        SceneDescription s = parse_scene(text, path("s.toml"), options_, diagnostics);
        EXPECT_EQ(errors(diagnostics), "") << text;
        EXPECT_TRUE(diagnostics.warnings().empty());
        return s;
    }
    // All messages for a text that must be wrong, without the folder.
    std::string problems(const std::string& text)
    {
        Diagnostics diagnostics;
        parse_scene(text, path("s.toml"), options_, diagnostics);
        return errors(diagnostics);
    }
    std::string errors(const Diagnostics& diagnostics) const
    {
        try {
            diagnostics.throw_if_errors();
            return "";
        } catch (const Error& e) {
            return without_folder(e.what());
        }
    }

    std::filesystem::path folder_;
    SceneFileOptions options_;
    std::vector<std::string> loaded_;  // by the mesh loader, in order
};

}  // namespace lancer
