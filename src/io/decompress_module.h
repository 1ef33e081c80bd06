// The C interface between the program and the module lancer_decompress, which alone is linked with zlib, liblzma and
// libzstd and is loaded only when a compressed file is read. No C++ types or exceptions cross it.
#pragma once

#include <cstdint>

extern "C" {

struct LancerDecompressor;

enum LancerCompression : int32_t { lancer_gzip, lancer_xz, lancer_zstd };

// Changes with every change of this file: a module left over from another build is refused.
constexpr int32_t lancer_decompress_current_version = 1;

int32_t lancer_decompress_version();
// bytes: the whole compressed file; it must outlive the decompressor. Null: no memory.
LancerDecompressor* lancer_decompress_open(int32_t compression, const unsigned char* bytes, uint64_t count);
// Writes up to `room` > 0 bytes to `out`; the number of them, 0 at the end of the file, or -1: see the message. Several
// streams one behind the other are read as one.
int64_t lancer_decompress_read(LancerDecompressor* decompressor, unsigned char* out, uint64_t room);
// What is wrong, after a failure.
const char* lancer_decompress_message(const LancerDecompressor* decompressor);
void lancer_decompress_close(LancerDecompressor* decompressor);
}
