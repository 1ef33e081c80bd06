// The C interface between the program and the module lancer_oiio, which alone is linked with OpenImageIO (260
// libraries, 0.2 s of start-up) and is loaded only when a picture needs it. No C++ types or exceptions cross it.
#pragma once

#include <cstdint>

extern "C" {

struct LancerOiioPicture;  // an open file

struct LancerOiioInfo {
    int32_t width, height;
    int32_t channels;       // of read_rows: 1: grey, 2: grey and alpha, 3: RGB, 4: RGBA
    int32_t kind;           // one of the kinds below
    int32_t block_rows;     // y0 of read_rows must be a multiple of this
    int32_t is_associated;  // colours are multiplied by alpha
    int32_t is_damaged;     // read_rows succeeded, but the decoder had to guess; see message
    char message[256];      // the reason, after a failure
};

// Kinds of values: bytes as stored; floats in [0, 1] for integers of more than 8 bits; floats as stored.
enum LancerOiioKind : int32_t { lancer_oiio_bytes, lancer_oiio_integers, lancer_oiio_floats };

// Changes with every change of this file: a module left over from another build is refused.
constexpr int32_t lancer_oiio_current_version = 4;

int32_t lancer_oiio_version();
// Opens with the decoder of this name and no other; allocates nothing for the pixels. Null: see info->message.
LancerOiioPicture* lancer_oiio_open(const char* path, const char* format, LancerOiioInfo* info);
// Rows y0 to y1 (half-open), channels interleaved, into bytes or floats as info->kind says. 0: see info->message.
int32_t lancer_oiio_read_rows(LancerOiioPicture* picture, int32_t y0, int32_t y1, void* values, LancerOiioInfo* info);
void lancer_oiio_close(LancerOiioPicture* picture);
}
