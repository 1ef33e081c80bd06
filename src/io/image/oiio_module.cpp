// The module lancer_oiio: the only file that knows OpenImageIO. io/image/read.cpp opens it and says which decoder.
#include "io/image/oiio_module.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <mutex>
#include <string>

struct LancerOiioPicture {
    std::unique_ptr<OIIO::ImageInput> input;
    OIIO::ImageSpec spec;
    int channels = 0;  // the first ones, handed out
    LancerOiioKind kind = lancer_oiio_bytes;
};

namespace {

void set_message(LancerOiioInfo* info, const std::string& text)
{
    const size_t length = std::min(text.size(), sizeof info->message - 1);
    std::copy_n(text.data(), length, info->message);
    info->message[length] = 0;
}

std::string error_of(OIIO::ImageInput& input)
{
    const std::string text = input.geterror();
    return text.empty() ? "damaged or cut short" : text;
}

// Some decoders report success and leave only an error text behind.
bool succeeded(bool ok, OIIO::ImageInput& input, LancerOiioInfo* info)
{
    if (ok && !input.has_error()) return true;
    set_message(info, error_of(input));
    return false;
}

// Grey or RGB, and the alpha behind it. In 32-bit bitmaps the fourth byte is more often nothing than alpha. Of GIF it
// is alpha, whatever OpenImageIO says of its place.
int find_channels(const OIIO::ImageSpec& spec, const std::string& format)
{
    const int colors = spec.nchannels < 3 ? 1 : 3;
    const bool has_alpha = format == "gif" ? spec.nchannels > colors : spec.alpha_channel == colors;
    return colors + (has_alpha && format != "bmp" ? 1 : 0);
}

LancerOiioKind find_kind(const OIIO::ImageSpec& spec)
{
    if (spec.format.is_floating_point()) return lancer_oiio_floats;
    return spec.format == OIIO::TypeDesc::UINT8 ? lancer_oiio_bytes : lancer_oiio_integers;
}

// To be held while a file is opened. OpenImageIO before 2.4.8.1 keeps what it meets in colour profiles in tables of the
// whole process, without a lock: two files opened at once could free memory twice.
std::unique_lock<std::mutex> lock_opening()
{
    static std::mutex mutex;
    constexpr int first_safe = 2'04'09;  // the number does not tell 2.4.8.1 from 2.4.8.0
    return OIIO::openimageio_version() < first_safe ? std::unique_lock(mutex) : std::unique_lock<std::mutex>();
}

LancerOiioPicture* open_picture(const char* path, const char* format, LancerOiioInfo* info)
{
    // Once: setting the number of threads while another thread reads ends in an assertion.
    static const bool configured = [] {
        // Otherwise a file that its own decoder refuses is offered to all the others.
        return OIIO::attribute("try_all_readers", 0) &&
               OIIO::attribute("threads", 1);  // the caller's threads are the only ones
    }();
    if (!configured) {
        set_message(info, "this OpenImageIO does not know the settings it needs");
        return nullptr;
    }
    auto picture = std::make_unique<LancerOiioPicture>();
    picture->input = OIIO::ImageInput::create(format);
    if (!picture->input) {
        set_message(info, std::string("this OpenImageIO has no decoder for ") + format);
        return nullptr;
    }
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);  // colours are not multiplied by alpha
    OIIO::ImageSpec& spec = picture->spec;
    const bool is_open = [&] {
        const auto lock = lock_opening();
        return picture->input->open(path, spec, config);
    }();
    if (!succeeded(is_open, *picture->input, info)) return nullptr;
    if (spec.deep || spec.depth > 1 || spec.nchannels < 1) {
        set_message(info, "not a flat picture");
        return nullptr;
    }
    constexpr int max_tile = 1 << 14;  // a decoder holds whole tiles
    if (spec.tile_width > max_tile || spec.tile_height > max_tile) {
        set_message(info, "tiles too large");
        return nullptr;
    }
    info->width = spec.width;
    info->height = spec.height;
    info->channels = picture->channels = find_channels(spec, format);
    info->kind = picture->kind = find_kind(spec);
    info->block_rows = std::max(spec.tile_height, 1);
    // The decoder of WebP multiplies whatever it is asked for, that of TIFF hands out what is stored. Of the others
    // alpha is 0 or 1, or as a file has it.
    const bool may_be_associated = format == std::string("tiff") || format == std::string("webp");
    const bool is_unassociated = spec.get_int_attribute("oiio:UnassociatedAlpha") != 0;
    info->is_associated = may_be_associated && info->channels % 2 == 0 && !is_unassociated ? 1 : 0;
    return picture.release();
}

bool read_rows(LancerOiioPicture& picture, int32_t y0, int32_t y1, void* values, LancerOiioInfo* info)
{
    OIIO::ImageInput& input = *picture.input;
    const OIIO::ImageSpec& spec = picture.spec;
    const bool is_bytes = picture.kind == lancer_oiio_bytes;
    const OIIO::TypeDesc type = is_bytes ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
    const int begin = spec.y + y0, end = spec.y + y1;
    const bool ok = spec.tile_width > 0
                        ? input.read_tiles(0, 0, spec.x, spec.x + spec.width, begin, end, spec.z, spec.z + 1, 0,
                                           picture.channels, type, values)
                        : input.read_scanlines(0, 0, begin, end, spec.z, 0, picture.channels, type, values);
    // That of JPEG fills what a cut file lacks with grey.
    if (ok && input.has_error() && input.format_name() == std::string("jpeg")) {
        info->is_damaged = 1;
        set_message(info, error_of(input));
        return true;
    }
    return succeeded(ok, input, info);
}

}  // namespace

extern "C" {

int32_t lancer_oiio_version() { return lancer_oiio_current_version; }

LancerOiioPicture* lancer_oiio_open(const char* path, const char* format, LancerOiioInfo* info)
{
    try {
        return open_picture(path, format, info);
    } catch (const std::exception& e) {
        set_message(info, e.what());
        return nullptr;
    }
}

int32_t lancer_oiio_read_rows(LancerOiioPicture* picture, int32_t y0, int32_t y1, void* values, LancerOiioInfo* info)
{
    try {
        return read_rows(*picture, y0, y1, values, info) ? 1 : 0;
    } catch (const std::exception& e) {
        set_message(info, e.what());
        return 0;
    }
}

void lancer_oiio_close(LancerOiioPicture* picture) { delete picture; }
}
