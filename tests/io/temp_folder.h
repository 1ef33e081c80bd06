// A fresh folder for the files of one test, and small helpers to look at files.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/image.h"

namespace lancer {

class TempFolder {
public:
    TempFolder()
    {
        std::string pattern = (std::filesystem::temp_directory_path() / "lancer-test-XXXXXX").string();
        if (!mkdtemp(pattern.data())) throw Error(ErrorKind::failed, "no temporary folder");
        path_ = pattern;
    }
    ~TempFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    const std::string& path() const { return path_; }
    std::string file(const std::string& name) const { return path_ + "/" + name; }
    std::vector<std::string> names() const
    {
        std::vector<std::string> result;
        for (const auto& entry : std::filesystem::directory_iterator(path_)) result.push_back(entry.path().filename());
        std::sort(result.begin(), result.end());
        return result;
    }

private:
    std::string path_;
};

inline std::string read_bytes(const std::string& path)
{
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline void write_bytes(const std::string& path, const std::string& bytes)
{
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

// The malformed files of a folder such as "exr"; none where the collection is not at hand.
std::vector<std::string> malformed_files(const std::string& folder);

// Expects an Error of this kind whose text names the path and contains the words.
void expect_error(ErrorKind kind, const std::string& path, const std::string& words,
                  const std::function<void()>& action);

// Reads a malformed file: it must either be read whole or be refused with its name.
void expect_read_or_refused(const std::string& path, const std::function<Image(const std::string&)>& read);

}  // namespace lancer
