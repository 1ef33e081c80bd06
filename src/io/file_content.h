// The bytes of a whole file, read by all threads, with what every reader of it asks: is it text, and its hash.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/raw_array.h"
#include "io/decompress.h"

namespace lancer {

// Whether a file that gzip, xz or zstd has compressed is read as what it holds, whatever its name.
enum class Unpack { no, yes };

class FileContent {
public:
    // Reads a regular file at once, in blocks by the threads of the innermost with_threads. Anything else (a folder, a
    // device) is a problem, as are compressed data that are damaged, if they are to be unpacked.
    explicit FileContent(const std::string& path, Unpack unpack = Unpack::no);

    const std::string& problem() const { return problem_; }  // empty if the file could be read
    bool missing() const { return missing_; }
    bool is_text() const { return is_text_; }  // no NUL character
    // Of all bytes of the file, compressed or not, as hash_bytes; of more than a block, of the hashes of the blocks.
    uint64_t hash() const { return hash_; }

    std::string_view bytes() const { return unpacked_ ? std::string_view(unpacked_.get(), size_) : file_bytes(); }
    std::string_view text() const;  // in UTF-8, without a byte order mark

private:
    void read(int descriptor, size_t size);
    void unpack_bytes();
    std::string_view file_bytes() const { return {bytes_.get(), size_}; }

    RawArray<char> bytes_;
    std::unique_ptr<char, FreeBytes> unpacked_;  // instead of bytes_
    size_t size_ = 0;
    std::string converted_;  // from UTF-16; empty if the bytes are the text
    std::string problem_;
    bool missing_ = false, is_text_ = true;
    uint64_t hash_ = 0;
};

// Gives the memory of what was read and is not needed any more back to the system, page by page; it then reads as
// zeros. For texts so large that it matters.
void give_back(std::string_view text);

}  // namespace lancer
