#include "io/file_content.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/hash.h"
#include "core/parallel.h"
#include "io/utf16.h"

namespace lancer {
namespace {

// Small enough that its bytes are still in the cache of the core that read them while they are looked at.
constexpr size_t block_size = size_t{1} << 20;

// Whether all of them could be read.
bool read_at(int descriptor, char* bytes, size_t count, size_t position)
{
    while (count > 0) {
        const ssize_t n = pread(descriptor, bytes, count, static_cast<off_t>(position));
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return false;
        bytes += n, position += static_cast<size_t>(n), count -= static_cast<size_t>(n);
    }
    return true;
}

}  // namespace

FileContent::FileContent(const std::string& path, Unpack unpack)
{
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) {
        missing_ = true;
        problem_ = "no such file";
        return;
    }
    if (!std::filesystem::is_regular_file(status)) {
        problem_ = std::filesystem::is_directory(status) ? "is a folder, not a file" : "not a regular file";
        return;
    }
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    const int reason = errno;
    const uintmax_t size = std::filesystem::file_size(path, error);
    if (descriptor < 0 || error)
        problem_ = std::string("cannot open: ") + std::strerror(descriptor < 0 ? reason : error.value());
    else
        read(descriptor, size);
    if (descriptor >= 0) close(descriptor);
    if (unpack == Unpack::yes) unpack_bytes();
    if (problem_.empty() && !is_text_)
        if (std::optional<std::string> text = text_of_utf16(bytes())) {
            converted_ = std::move(*text);
            is_text_ = converted_.find('\0') == std::string::npos;
        }
}

void FileContent::unpack_bytes()
{
    const std::optional<Compression> compression = compression_of(file_bytes());
    if (!compression) return;
    UnpackedBytes unpacked = unpack(file_bytes(), *compression);
    bytes_ = {};
    problem_ = unpacked.problem;
    size_ = unpacked.size;
    unpacked_ = std::move(unpacked.bytes);
    is_text_ = !std::memchr(unpacked_ ? unpacked_.get() : "", '\0', size_);
}

void FileContent::read(int descriptor, size_t size)
{
    bytes_ = RawArray<char>(size);  // each page is given to the thread that reads into it
    std::vector<uint64_t> hashes((size + block_size - 1) / block_size);
    std::atomic<bool> complete{true}, is_text{true};
    parallel_for(hashes.size(), [&](size_t i) {
        const size_t begin = i * block_size, count = std::min(block_size, size - begin);
        char* const block = bytes_.get() + begin;
        if (!read_at(descriptor, block, count, begin)) {
            complete = false;
            return;
        }
        if (std::memchr(block, '\0', count)) is_text = false;
        hashes[i] = hash_bytes({block, count});
    });
    if (!complete) {
        bytes_ = {};
        problem_ = "cannot be read to its end";
        return;
    }
    size_ = size;
    is_text_ = is_text;
    hash_ = hashes.size() == 1
                ? hashes[0]
                : hash_bytes({reinterpret_cast<const char*>(hashes.data()), sizeof(uint64_t) * hashes.size()});
}

std::string_view FileContent::text() const
{
    if (!converted_.empty()) return converted_;
    const std::string_view all = bytes();
    return all.starts_with("\xEF\xBB\xBF") ? all.substr(3) : all;
}

void give_back(std::string_view text)
{
    // Those pages alone on which there is nothing else: private memory, not that of a file.
    const auto page = static_cast<uintptr_t>(sysconf(_SC_PAGESIZE));
    const auto begin = reinterpret_cast<uintptr_t>(text.data()), end = begin + text.size();
    const uintptr_t first = (begin + page - 1) / page * page, last = end / page * page;
    if (first < last) madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED);
}

}  // namespace lancer
