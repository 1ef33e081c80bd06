// Numbers and texts of a checkpoint, in one order for writing and for reading: a function that visits a state's members
// with a Saver writes them, with a Loader it reads them back.
#pragma once

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/error.h"
#include "core/hash.h"
#include "io/atomic_file.h"

namespace lancer {

// The hash that ends a file is made of pieces of so many bytes.
inline constexpr size_t hashed_at_once = size_t{1} << 20;

// Appends numbers as they are in memory, and their hash at the end.
class Saver {
public:
    static constexpr bool loads = false;
    explicit Saver(AtomicFile& file) : file_(file), buffer_(hashed_at_once) {}

    void bytes(const void* from, size_t count)
    {
        const auto* next = static_cast<const char*>(from);
        while (count > 0) {
            const size_t n = std::min(count, hashed_at_once - used_);
            std::memcpy(&buffer_[used_], next, n);
            next += n, count -= n, used_ += n;
            if (used_ == hashed_at_once) flush();
        }
    }
    template <class T>
    void operator()(const T& x)
    {
        static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
        // The usual case, without a loop: there are millions of numbers.
        if (used_ + sizeof x >= hashed_at_once) return bytes(&x, sizeof x);
        std::memcpy(&buffer_[used_], &x, sizeof x);
        used_ += sizeof x;
    }
    void operator()(const std::string& text)
    {
        (*this)(uint64_t{text.size()});
        bytes(text.data(), text.size());
    }
    // visit(element) for each, after their number.
    template <class T, class F>
    void each(const std::vector<T>& all, const F& visit)
    {
        (*this)(uint64_t{all.size()});
        for (const T& x : all) visit(x);
    }
    void end()
    {
        if (used_ > 0) flush();
        file_.write(&hash_, sizeof hash_);
    }

private:
    void flush()
    {
        hash_ = hash_bytes({buffer_.data(), used_}, hash_);
        file_.write(buffer_.data(), used_);
        used_ = 0;
    }

    AtomicFile& file_;
    std::vector<char> buffer_;
    size_t used_ = 0;
    uint64_t hash_ = 0;
};

class Loader {
public:
    static constexpr bool loads = true;
    Loader(const std::string& path, std::string_view bytes) : path_(path), rest_(bytes) {}

    [[noreturn]] void fail(const std::string& what) const { throw Error(ErrorKind::invalid_input, {path_}, what); }
    [[noreturn]] void fail_damaged() const { fail("this checkpoint is damaged"); }

    std::string_view bytes(size_t count)
    {
        if (count > rest_.size()) fail_damaged();
        const std::string_view taken = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return taken;
    }
    template <class T>
    void operator()(T& x)
    {
        std::memcpy(&x, bytes(sizeof x).data(), sizeof x);
    }
    void operator()(std::string& text) { text = bytes(count()); }
    // An element has at least a quarter of its size in memory, so no more is asked for than four times the file.
    template <class T, class F>
    void each(std::vector<T>& all, const F& visit)
    {
        all.resize(count(std::max<size_t>(1, sizeof(T) / 4)));
        for (T& x : all) visit(x);
    }
    bool is_at_end() const { return rest_.empty(); }
    // Of bytes that Saver wrote.
    static uint64_t hash_of(std::string_view bytes)
    {
        uint64_t hash = 0;
        do {
            hash = hash_bytes(bytes.substr(0, hashed_at_once), hash);
            bytes.remove_prefix(std::min(bytes.size(), hashed_at_once));
        } while (!bytes.empty());
        return hash;
    }

private:
    size_t count(size_t least_bytes = 1)
    {
        uint64_t count = 0;
        (*this)(count);
        if (count > rest_.size() / least_bytes) fail_damaged();
        return static_cast<size_t>(count);
    }

    std::string path_;
    std::string_view rest_;
};

// What has no bytes of its own goes by way of a number. Any: T or const T, as for all that follows.
template <class Stream, class Any>
void visit_flag(Stream& stream, Any& flag)
{
    uint32_t number = flag ? 1 : 0;
    stream(number);
    if constexpr (Stream::loads) flag = number != 0;
}

// count: of the enumerators.
template <class Stream, class Any>
void visit_enum(Stream& stream, Any& value, size_t count)
{
    auto number = static_cast<uint32_t>(value);
    stream(number);
    if constexpr (Stream::loads) {
        if (number >= count) stream.fail_damaged();
        value = static_cast<Any>(number);
    }
}

template <class Stream, class Any>
void visit_optional(Stream& stream, Any& value)
{
    uint32_t has = value.has_value() ? 1 : 0;
    auto number = value.value_or(0);
    stream(has), stream(number);
    if constexpr (Stream::loads) {
        value.reset();
        if (has != 0) value = number;
    }
}

}  // namespace lancer
