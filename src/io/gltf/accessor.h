// Accessors of glTF files: numbers of one type in a buffer, checked against its size, and read in parallel.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "io/gltf/buffers.h"

namespace lancer {

enum class GltfComponent : uint16_t { int8 = 5120, uint8, int16, uint16, uint32 = 5125, float32 };

constexpr size_t size_of(GltfComponent c)
{
    return c == GltfComponent::int8 || c == GltfComponent::uint8     ? 1
           : c == GltfComponent::int16 || c == GltfComponent::uint16 ? 2
                                                                     : 4;
}

struct GltfAccessor {
    const JsonValue* json = nullptr;
    size_t count = 0, components = 1;
    GltfComponent type = GltfComponent::float32;
    bool normalized = false;
    const char* data = nullptr;                        // of the first element; null: all are zero
    size_t stride = 0;                                 // bytes from one to the next
    std::shared_ptr<const std::vector<char>> owned{};  // that data is in, if it is in no buffer
    // Elements that stand elsewhere.
    struct Sparse {
        size_t count = 0;
        GltfComponent index_type = GltfComponent::uint32;
        const char *indices = nullptr, *values = nullptr;
    } sparse{};

    size_t element_size() const { return components * size_of(type); }
};

// Of an element of 'accessors'. Throws Error if what it says is wrong or not within its buffer.
GltfAccessor open_accessor(const JsonValue& accessor, GltfDocument& document, GltfBuffers& buffers);
// What it says of its numbers; where they stand is another's to say.
GltfAccessor accessor_without_data(const JsonValue& accessor, GltfDocument& document);
// "VEC3" has 3; nothing for an unknown type.
std::optional<size_t> components_of(std::string_view type);

inline constexpr size_t gltf_block = 1 << 15;  // elements that a thread reads at a time

// f(i) for all i, by all threads.
template <class F>
void for_each_index(size_t count, const F& f)
{
    parallel_for((count + gltf_block - 1) / gltf_block, [&](size_t b) {
        for (size_t i = b * gltf_block; i < std::min(count, (b + 1) * gltf_block); ++i) f(i);
    });
}

namespace gltf_numbers {

template <class T>
double number_at(const char* at, bool normalized)
{
    T value;
    std::memcpy(&value, at, sizeof value);
    const auto number = static_cast<double>(value);
    if (!normalized || std::is_same_v<T, float>) return number;
    return std::max(number / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
}

// f(T{}) for the type of a component.
template <class F>
void with_type(GltfComponent type, const F& f)
{
    switch (type) {
        case GltfComponent::int8:
            return f(int8_t{});
        case GltfComponent::uint8:
            return f(uint8_t{});
        case GltfComponent::int16:
            return f(int16_t{});
        case GltfComponent::uint16:
            return f(uint16_t{});
        case GltfComponent::uint32:
            return f(uint32_t{});
        case GltfComponent::float32:
            return f(float{});
    }
}

}  // namespace gltf_numbers

// An index of a list of them.
size_t index_at(const char* data, GltfComponent type, size_t i);

// f(i, values): element i, as an array of n numbers; n: at most the components. In any order, by all threads; those of
// a sparse accessor last.
template <size_t n, class F>
void for_each_element(const GltfAccessor& a, const F& f)
{
    gltf_numbers::with_type(a.type, [&]<class T>(T) {
        const auto element = [&](const char* at) {
            std::array<double, n> values{};
            for (size_t c = 0; at && c < n; ++c)
                values[c] = gltf_numbers::number_at<T>(at + c * sizeof(T), a.normalized);
            return values;
        };
        for_each_index(a.count, [&](size_t i) { f(i, element(a.data ? a.data + i * a.stride : nullptr)); });
        for (size_t s = 0; s < a.sparse.count; ++s)
            f(index_at(a.sparse.indices, a.sparse.index_type, s), element(a.sparse.values + s * a.element_size()));
    });
}

// The numbers of a list of one component each, as integers of 32 bits. Throws Error if they are of another kind.
class GltfIndices {
public:
    GltfIndices(const GltfAccessor& accessor, const GltfDocument& document);
    // f(at) once; at(i): index i.
    template <class F>
    void read(const F& f) const
    {
        if (!own_.empty()) return f([this](size_t i) { return own_[i]; });
        gltf_numbers::with_type(accessor_.type, [&]<class T>(T) {
            if constexpr (std::is_unsigned_v<T>)
                f([data = accessor_.data, stride = accessor_.stride](size_t i) {
                    T value{};
                    if (data) std::memcpy(&value, data + i * stride, sizeof value);
                    return static_cast<uint32_t>(value);
                });
        });
    }
    size_t count() const { return accessor_.count; }

private:
    const GltfAccessor& accessor_;
    std::vector<uint32_t> own_;  // of a sparse one
};

}  // namespace lancer
