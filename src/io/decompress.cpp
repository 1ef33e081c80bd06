#include "io/decompress.h"

#include <unistd.h>

#include <algorithm>
#include <new>

#include "core/error.h"
#include "io/decompress_module.h"
#include "io/module_file.h"

namespace lancer {
namespace {

struct DecompressModule {
    decltype(&lancer_decompress_open) open;
    decltype(&lancer_decompress_read) read;
    decltype(&lancer_decompress_message) message;
    decltype(&lancer_decompress_close) close;
};

DecompressModule load_decompress()
{
    void* const library = open_module("lancer_decompress", lancer_decompress_current_version,
                                      "which reads compressed files, is missing; build the target lancer_decompress "
                                      "(it needs zlib1g-dev, liblzma-dev and libzstd-dev) or unpack the file");
    DecompressModule m = {};
    find_symbol(library, "lancer_decompress_open", m.open);
    find_symbol(library, "lancer_decompress_read", m.read);
    find_symbol(library, "lancer_decompress_message", m.message);
    find_symbol(library, "lancer_decompress_close", m.close);
    return m;
}

size_t bytes_of_memory()
{
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    return pages > 0 && page > 0 ? static_cast<size_t>(pages) * static_cast<size_t>(page) : SIZE_MAX;
}

void resize(UnpackedBytes& u, size_t capacity)
{
    void* const moved = std::realloc(u.bytes.get(), capacity);
    if (!moved) throw std::bad_alloc();
    static_cast<void>(u.bytes.release());
    u.bytes.reset(static_cast<char*>(moved));
}

}  // namespace

std::optional<Compression> compression_of(std::string_view bytes)
{
    using namespace std::string_view_literals;
    if (bytes.starts_with("\x1F\x8B"sv)) return Compression::gzip;
    if (bytes.starts_with("\xFD\x37\x7A\x58\x5A\x00"sv)) return Compression::xz;
    if (bytes.starts_with("\x28\xB5\x2F\xFD"sv)) return Compression::zstd;
    return {};
}

UnpackedBytes unpack(std::string_view bytes, Compression compression)
{
    UnpackedBytes unpacked;
    try {
        static const DecompressModule module = load_decompress();
        constexpr int32_t codes[] = {lancer_gzip, lancer_xz, lancer_zstd};
        const std::unique_ptr<LancerDecompressor, decltype(module.close)> stream(
            module.open(codes[static_cast<size_t>(compression)], reinterpret_cast<const unsigned char*>(bytes.data()),
                        bytes.size()),
            module.close);
        if (!stream) throw std::bad_alloc();
        const size_t most = bytes_of_memory();
        for (size_t capacity = std::max<size_t>(4 * bytes.size(), 65536); unpacked.problem.empty();
             capacity += capacity / 2) {
            resize(unpacked, capacity);
            int64_t n = 0;
            do {
                n = module.read(stream.get(), reinterpret_cast<unsigned char*>(unpacked.bytes.get()) + unpacked.size,
                                capacity - unpacked.size);
                if (n > 0) unpacked.size += static_cast<size_t>(n);
            } while (n > 0 && unpacked.size < capacity);
            if (n < 0) unpacked.problem = module.message(stream.get());
            if (n == 0) break;
            if (unpacked.size > most) unpacked.problem = "unpacked it is larger than this machine's memory";
        }
        if (unpacked.size > 0 && unpacked.problem.empty()) resize(unpacked, unpacked.size);
    } catch (const Error& error) {
        const std::string text = error.what();  // "error: reason"
        unpacked.problem = text.substr(std::min(text.size(), text.find(' ') + 1));
    } catch (const std::bad_alloc&) {
        unpacked.problem = "there is no memory to unpack it";
    }
    if (!unpacked.problem.empty()) unpacked.bytes.reset(), unpacked.size = 0;
    return unpacked;
}

}  // namespace lancer
