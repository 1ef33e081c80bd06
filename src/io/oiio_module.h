// The seam between the program and the module lancer_oiio, which alone is linked with OpenImageIO (260 libraries, 0.2 s
// of start-up) and opened only when a picture needs it. Plain C: nothing of C++ crosses, exceptions included.
#pragma once

#include <cstdint>

extern "C" {

struct LancerOiioPicture;  // an open file

struct LancerOiioInfo {
    int32_t width, height;
    int32_t channels;    // what read_rows hands out: 1 (grey) or 3; alpha is dropped, the colour below it kept
    int32_t is_integer;  // 1: stored as integers, here scaled to 0 to 1; 0: stored as floats
    int32_t block_rows;  // read_rows wants y0 to be a multiple of this
    char message[256];   // the reason, after a failure
};

// Changes with every change of this file: a module left over from another build is refused.
constexpr int32_t lancer_oiio_current_version = 1;

int32_t lancer_oiio_version();
// Opens with the decoder of this name and no other; allocates nothing for the pixels. Null: see info->message.
LancerOiioPicture* lancer_oiio_open(const char* path, const char* format, LancerOiioInfo* info);
// Rows y0 to y1 (half-open) into rgb, 3 floats apart for each pixel. 0: see info->message.
int32_t lancer_oiio_read_rows(LancerOiioPicture* picture, int32_t y0, int32_t y1, float* rgb, LancerOiioInfo* info);
void lancer_oiio_close(LancerOiioPicture* picture);
}
