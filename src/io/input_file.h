// A file to read a picture from: opened once, of known size, never a folder or a pipe that would block. A name of a
// part of a file (io/file_part.h) opens that part.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include "core/error.h"

namespace lancer {

// More pixels than this are refused before anything is allocated for them: the size fields of a broken file can say
// anything. 2^28 pixels are 3 GB here, four times the largest environment map in use.
constexpr int64_t max_image_pixels = int64_t{1} << 28;
constexpr int32_t max_image_side = 65536;

class InputFile {
public:
    // Missing or unreadable: ErrorKind::missing_input. Not a regular file: invalid_input.
    explicit InputFile(const std::string& path);

    // As many bytes as there are, up to count.
    size_t read(void* bytes, size_t count);
    void seek(uint64_t position);
    uint64_t tell();
    uint64_t size() const { return size_; }
    const std::string& path() const { return path_; }
    // Under which a library may open it as well, while this is open.
    const std::string& real_path() const { return real_path_; }

    // "path: error: message", to be thrown.
    Error invalid(const std::string& message) const { return {ErrorKind::invalid_input, {path_}, message}; }

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::string path_, real_path_;
    uint64_t size_ = 0;
    std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace lancer
