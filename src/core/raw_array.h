// Memory for many objects without running their constructors. No page is touched before it is used; large arrays use
// huge pages where the system offers them.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

namespace lancer {

template <class T>
class RawArray {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

public:
    RawArray() = default;
    // At least 64-byte aligned. Throws std::bad_alloc.
    explicit RawArray(size_t size)
    {
        constexpr size_t huge = size_t{2} << 20;
        size_t bytes = size * sizeof(T);
        const size_t alignment = bytes < huge ? 64 : huge;
        bytes = (bytes + alignment - 1) / alignment * alignment;
        data_.reset(static_cast<T*>(std::aligned_alloc(alignment, bytes)));
        if (!data_) throw std::bad_alloc();
        if (alignment == huge) madvise(data_.get(), bytes, MADV_HUGEPAGE);  // a hint; failure is harmless
    }

    T* get() { return data_.get(); }
    const T* get() const { return data_.get(); }
    T& operator[](size_t i) { return data_.get()[i]; }
    const T& operator[](size_t i) const { return data_.get()[i]; }

private:
    struct Free {
        void operator()(T* p) const { std::free(p); }
    };
    std::unique_ptr<T, Free> data_;
};

}  // namespace lancer
