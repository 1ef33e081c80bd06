// The C interface between the program and the module lancer_ocio, which alone is linked with OpenColorIO and is loaded
// only when a picture is to be drawn by one of its views. No C++ types or exceptions cross it.
#pragma once

#include <cstdint>

extern "C" {

struct LancerOcioView;  // the way from linear Rec. 709 to code values of a display

struct LancerOcioInfo {
    char input[256];     // the color space of the configuration that stands for linear Rec. 709
    char display[256];   // the display, also where none was asked for
    char view[256];      // likewise
    int32_t is_unknown;  // a failure because the configuration has no such display or view
    char message[2048];  // the reason, after a failure
};

// Changes with every change of this file: a module left over from another build is refused.
constexpr int32_t lancer_ocio_current_version = 1;

int32_t lancer_ocio_version();
// config: a file, or what else the library takes for a name. display, view: "" for the configuration's default. Null:
// see info->message, which lists what there is where a name is unknown.
LancerOcioView* lancer_ocio_open(const char* config, const char* display, const char* view, LancerOcioInfo* info);
// Turns pixels, three floats each, into code values. 0: see info->message. Of one view, for one thread at a time.
int32_t lancer_ocio_apply(LancerOcioView* view, float* pixels, int64_t count, LancerOcioInfo* info);
void lancer_ocio_close(LancerOcioView* view);
}
