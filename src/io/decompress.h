// Files compressed by gzip, xz or zstd.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace lancer {

enum class Compression { gzip, xz, zstd };

// By the first bytes of a file; nothing if it is not compressed.
std::optional<Compression> compression_of(std::string_view bytes);

// Memory whose growth copies nothing where the system can move pages.
struct FreeBytes {
    void operator()(char* p) const { std::free(p); }
};
struct UnpackedBytes {
    std::unique_ptr<char, FreeBytes> bytes;
    size_t size = 0;
    std::string problem;  // empty if all could be unpacked
};

// By one thread: all three formats are serial. More bytes than this machine has memory are a problem, as is a missing
// module.
UnpackedBytes unpack(std::string_view bytes, Compression compression);

}  // namespace lancer
