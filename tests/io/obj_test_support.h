// A folder of OBJ and MTL files for each test, and what loading them says.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "io/obj/obj.h"

namespace lancer {

namespace fs = std::filesystem;
using Triangle = std::array<uint32_t, 3>;

// A new folder for each test; messages are compared without its path.
class ObjTest : public testing::Test {
protected:
    void SetUp() override
    {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::path(testing::TempDir()) / ("lancer_obj_" + std::string(info->name()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string write(const std::string& name, const std::string& text)
    {
        fs::remove(folder_ / name);  // overwriting makes some file systems wait for the disk
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return (folder_ / name).string();
    }
    std::shared_ptr<const MeshData> load(const std::string& text)
    {
        diagnostics_ = {};
        return load_obj(write("a.obj", text), diagnostics_);
    }
    std::shared_ptr<const MeshData> load_with(const std::string& mtl, const std::string& uses)
    {
        write("a.mtl", mtl);
        return load("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n" + uses);
    }
    std::string relative(std::string text) const
    {
        const std::string prefix = folder_.string() + "/";
        for (size_t at; (at = text.find(prefix)) != std::string::npos;) text.erase(at, prefix.size());
        return text;
    }
    std::vector<std::string> warnings() const
    {
        std::vector<std::string> all;
        for (const auto& w : diagnostics_.warnings()) all.push_back(relative(to_string(w)));
        return all;
    }
    std::string errors() const
    {
        try {
            diagnostics_.throw_if_errors();
        } catch (const Error& e) {
            return relative(e.what());
        }
        return "";
    }
    std::string error_of(const std::string& text)
    {
        EXPECT_EQ(load(text), nullptr) << text;
        return errors();
    }

    fs::path folder_;
    Diagnostics diagnostics_;
};

inline const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
inline const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

// Real and broken files are not part of the source; the tests pass without them.
fs::path shared_folder();

}  // namespace lancer
