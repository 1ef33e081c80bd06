// The header of a PLY file: in which form its elements follow, and what each of them has.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace lancer {

enum class PlyType : uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

constexpr size_t size_of(PlyType type)
{
    constexpr size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<size_t>(type)];
}

// For whole numbers the largest value, which colours have where they are full; else 1.
constexpr double full_value(PlyType type)
{
    constexpr double values[] = {127, 255, 32767, 65535, 2147483647, 4294967295, 1, 1};
    return values[static_cast<size_t>(type)];
}

struct PlyProperty {
    std::string name;
    PlyType type;
    std::optional<PlyType> count{};  // of a list: the type of its length
};

struct PlyElement {
    std::string name;
    uint64_t count = 0;
    std::vector<PlyProperty> properties;

    // Bytes of one in a binary file; of each list its length alone.
    size_t least_size() const;
    bool has_list() const;
};

struct PlyHeader {
    enum class Form { text, little_endian, big_endian };
    Form form = Form::text;
    std::vector<PlyElement> elements;
    size_t end = 0;         // where the elements begin, in bytes
    uint32_t end_line = 0;  // lines of the header

    // Whether bytes of numbers must be reversed.
    bool swaps() const { return (form == Form::big_endian) == (std::endian::native == std::endian::little); }
};

// Nothing after adding an error.
std::optional<PlyHeader> read_ply_header(std::string_view bytes, const std::string& file, Diagnostics& diagnostics);

}  // namespace lancer
