// What the fuzz targets share: the input as a file, and what a reader may do with it.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "core/error.h"

namespace lancer::fuzz {

inline std::string_view as_text(const uint8_t* data, size_t size)
{
    return {reinterpret_cast<const char*>(data), size};
}

// A file in memory that holds the bytes until the next call. Returns its path.
inline const std::string& as_file(std::string_view bytes)
{
    static const int descriptor = memfd_create("input", MFD_CLOEXEC);
    static const std::string path = "/proc/self/fd/" + std::to_string(descriptor);
    const auto size = static_cast<ssize_t>(bytes.size());
    if (descriptor < 0 || ftruncate(descriptor, size) != 0 || pwrite(descriptor, bytes.data(), bytes.size(), 0) != size)
        std::abort();
    return path;
}

// Whether the reader took the input. Anything that it throws but Error ends the process.
template <class F>
bool reads(const F& reader)
{
    try {
        reader();
        return true;
    } catch (const Error&) {
        return false;
    }
}

// What must hold whatever the input is.
inline void require(bool holds)
{
    if (!holds) std::abort();
}

}  // namespace lancer::fuzz
