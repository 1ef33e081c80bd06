#include "io/decompress_module.h"

#include <lzma.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <new>
#include <utility>
#include <variant>

namespace {

// A file on its way through a library. Each has read(): the number of bytes written to `out`, 0 at the end, -1 after a
// failure.
struct Stream {
    Stream(const unsigned char* bytes, uint64_t count) : in(bytes), left(count) {}
    Stream(const Stream&) = delete;

    int64_t fail(const char* what)
    {
        message = what;
        return -1;
    }

    const unsigned char* in;
    uint64_t left;  // bytes from `in` on
    const char* message = "";
};

constexpr const char* damaged = "the compressed data are damaged";
constexpr const char* truncated = "the compressed data end too early";

// Libraries count in 32 bits.
uInt bounded(uint64_t n) { return static_cast<uInt>(std::min<uint64_t>(n, std::numeric_limits<uInt>::max())); }

struct Gzip : Stream {
    Gzip(const unsigned char* bytes, uint64_t count) : Stream(bytes, count)
    {
        if (inflateInit2(&stream, 16 + MAX_WBITS) != Z_OK) throw std::bad_alloc();  // 16: a header of gzip
    }
    ~Gzip() { inflateEnd(&stream); }
    int64_t read(unsigned char* out, uint64_t room)
    {
        while (true) {
            // What follows a stream and is none (padding, as tar leaves it) is ignored, as by gzip itself.
            if (at_end && (left < 2 || in[0] != 0x1f || in[1] != 0x8b)) return 0;
            if (at_end && inflateReset(&stream) != Z_OK) return fail(damaged);
            at_end = false;
            const uInt given = bounded(left), space = bounded(room);
            stream.next_in = const_cast<unsigned char*>(in), stream.avail_in = given;
            stream.next_out = out, stream.avail_out = space;
            const int result = inflate(&stream, Z_NO_FLUSH);
            in += given - stream.avail_in, left -= given - stream.avail_in;
            const uInt written = space - stream.avail_out;
            at_end = result == Z_STREAM_END;
            if (!at_end && result != Z_OK && result != Z_BUF_ERROR) return fail(damaged);
            if (written > 0) return written;
            if (!at_end && left == 0) return fail(truncated);
        }
    }

    z_stream stream{};
    bool at_end = false;
};

struct Xz : Stream {
    Xz(const unsigned char* bytes, uint64_t count) : Stream(bytes, count)
    {
        constexpr uint64_t most_memory = uint64_t{1} << 30;  // of the dictionary: what `xz -9` makes needs 65 MB
        if (lzma_stream_decoder(&stream, most_memory, LZMA_CONCATENATED) != LZMA_OK) throw std::bad_alloc();
        stream.next_in = bytes, stream.avail_in = count;
    }
    ~Xz() { lzma_end(&stream); }
    int64_t read(unsigned char* out, uint64_t room)
    {
        if (at_end) return 0;
        stream.next_out = out, stream.avail_out = room;
        while (stream.avail_out == room && !at_end) {
            const lzma_ret result = lzma_code(&stream, LZMA_FINISH);
            at_end = result == LZMA_STREAM_END;
            if (result == LZMA_BUF_ERROR) return fail(truncated);
            if (result == LZMA_MEMLIMIT_ERROR) return fail("unpacking it needs more than 1 GiB by itself");
            if (!at_end && result != LZMA_OK) return fail(damaged);
        }
        return static_cast<int64_t>(room - stream.avail_out);
    }

    lzma_stream stream = LZMA_STREAM_INIT;
    bool at_end = false;
};

struct Zstd : Stream {
    Zstd(const unsigned char* bytes, uint64_t count) : Stream(bytes, count)
    {
        if (!stream) throw std::bad_alloc();
        ZSTD_DCtx_setParameter(stream.get(), ZSTD_d_windowLogMax, 30);  // as `zstd --long=30`; by itself 27
    }
    int64_t read(unsigned char* out, uint64_t room)
    {
        ZSTD_inBuffer source{in, left, 0};
        ZSTD_outBuffer target{out, room, 0};
        while (target.pos == 0) {
            if (source.pos == source.size && !is_in_frame) break;
            const size_t before = source.pos, result = ZSTD_decompressStream(stream.get(), &target, &source);
            if (ZSTD_isError(result)) return fail(damaged);
            is_in_frame = result != 0;
            if (is_in_frame && target.pos == 0 && source.pos == before && source.pos == source.size)
                return fail(truncated);
        }
        in += source.pos, left -= source.pos;
        return static_cast<int64_t>(target.pos);
    }

    struct Free {
        void operator()(ZSTD_DStream* s) const { ZSTD_freeDStream(s); }
    };
    std::unique_ptr<ZSTD_DStream, Free> stream{ZSTD_createDStream()};
    bool is_in_frame = true;
};

}  // namespace

struct LancerDecompressor {
    template <class S>
    LancerDecompressor(std::in_place_type_t<S> kind, const unsigned char* bytes, uint64_t count)
        : stream(kind, bytes, count)
    {
    }
    std::variant<Gzip, Xz, Zstd> stream;
};

int32_t lancer_decompress_version() { return lancer_decompress_current_version; }

LancerDecompressor* lancer_decompress_open(int32_t compression, const unsigned char* bytes, uint64_t count)
{
    try {
        if (compression == lancer_gzip) return new LancerDecompressor(std::in_place_type<Gzip>, bytes, count);
        if (compression == lancer_xz) return new LancerDecompressor(std::in_place_type<Xz>, bytes, count);
        return new LancerDecompressor(std::in_place_type<Zstd>, bytes, count);
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}

int64_t lancer_decompress_read(LancerDecompressor* d, unsigned char* out, uint64_t room)
{
    return std::visit([=](auto& stream) { return stream.read(out, room); }, d->stream);
}

const char* lancer_decompress_message(const LancerDecompressor* d)
{
    return std::visit([](const Stream& stream) { return stream.message; }, d->stream);
}

void lancer_decompress_close(LancerDecompressor* d) { delete d; }
