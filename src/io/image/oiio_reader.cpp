#include "io/image/oiio_reader.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "io/image/oiio_module.h"
#include "io/image/radiance.h"
#include "io/image/sizes.h"
#include "io/module_file.h"

namespace lancer {
namespace {

struct OiioModule {
    decltype(&lancer_oiio_open) open;
    decltype(&lancer_oiio_read_rows) read_rows;
    decltype(&lancer_oiio_close) close;
};

OiioModule load_oiio()
{
    void* const library =
        open_module("lancer_oiio", lancer_oiio_current_version,
                    "which reads pictures other than EXR, PNG, JPEG and TGA, is missing; build the target lancer_oiio "
                    "(it needs libopenimageio-dev) or convert the pictures");
    OiioModule m = {};
    find_symbol(library, "lancer_oiio_open", m.open);
    find_symbol(library, "lancer_oiio_read_rows", m.read_rows);
    find_symbol(library, "lancer_oiio_close", m.close);
    return m;
}

// Room grows with the rows read: reserved memory costs nothing until it is filled, and it is filled only as far as the
// file truly has rows.
template <class Value, class ReadRows>
bool read_rows(std::vector<Value>& values, const LancerOiioInfo& info, const ReadRows& read)
{
    const size_t row = static_cast<size_t>(info.width) * static_cast<size_t>(info.channels);
    values.reserve(row * static_cast<size_t>(info.height));
    const int32_t rows_at_once = std::max(64 / info.block_rows, 1) * info.block_rows;
    for (int32_t y0 = 0; y0 < info.height; y0 += rows_at_once) {
        const int32_t y1 = std::min(y0 + rows_at_once, info.height);
        values.resize(row * static_cast<size_t>(y1));
        if (!read(y0, y1, &values[row * static_cast<size_t>(y0)])) return false;
    }
    return true;
}

// An open file, with what it says of its picture.
struct OpenPicture {
    LancerOiioInfo info = {};
    std::unique_ptr<LancerOiioPicture, decltype(OiioModule::close)> picture{nullptr, nullptr};
};

Error broken(const InputFile& file, const std::string& format, const LancerOiioInfo& info)
{
    return file.invalid("not a valid " + format + " file: " + info.message);
}

const OiioModule& module()
{
    static const OiioModule loaded = load_oiio();  // a failure is tried again next time
    return loaded;
}

OpenPicture open(const InputFile& file, const std::string& format)
{
    OpenPicture result;
    result.picture = {module().open(file.real_path().c_str(), format.c_str(), &result.info), module().close};
    if (!result.picture) throw broken(file, format, result.info);
    return result;
}

void check_size(const InputFile& file, int64_t width, int64_t height)
{
    const std::string size = std::to_string(width) + " x " + std::to_string(height);
    if (width <= 0 || height <= 0) throw file.invalid("the picture is " + size + " pixels");
    if (width > max_image_side || height > max_image_side || width * height > max_image_pixels)
        throw file.invalid("picture too large: " + size + " pixels");
}

// OpenImageIO decodes run-length encoded bitmaps while it opens them, before their size can be checked.
void check_bmp(InputFile& file)
{
    std::array<uint8_t, 34> b = {};
    file.seek(0);
    if (file.read(b.data(), b.size()) != b.size()) throw file.invalid("not a valid bmp file: the file ends too early");
    constexpr uint8_t old_header_size = 12, plain = 0, bit_fields = 3;
    if (b[14] != old_header_size && b[30] != plain && b[30] != bit_fields) {
        throw file.invalid("compressed bmp files are not read");
    }
}

// What lancer reads itself of the beginning of a file, before OpenImageIO opens it.
struct Start {
    std::optional<RasterHeader> header;  // where its decoder would make room for the pixels in opening
    std::optional<RadianceHeader> radiance;
};

Start read_start(InputFile& file, const std::string& format)
{
    Start start;
    if (format == "bmp") check_bmp(file);
    if (format == "hdr") start.radiance = read_radiance_header(file);
    if (format == "gif") start.header = read_gif_size(file);
    if (format == "webp") start.header = read_webp_size(file);
    if (format == "dds") start.header = read_dds_size(file);
    if (start.header) check_size(file, start.header->width, start.header->height);
    return start;
}

}  // namespace

RasterHeader read_header_with_oiio(InputFile& file, const std::string& format)
{
    const Start start = read_start(file, format);
    if (start.header && format != "dds") return *start.header;
    if (const auto& r = start.radiance) {
        check_size(file, r->width, r->height);
        RasterHeader header{.width = r->width, .height = r->height, .channels = 3};
        header.values = RasterHeader::Values::floats;
        header.decoder_bytes = r->is_turned() ? header.bytes() : 0;
        return header;
    }
    const OpenPicture open_picture = open(file, format);
    const LancerOiioInfo& info = open_picture.info;
    check_size(file, info.width, info.height);
    using enum RasterHeader::Values;
    return {.width = static_cast<uint32_t>(info.width),
            .height = static_cast<uint32_t>(info.height),
            .channels = static_cast<uint32_t>(info.channels),
            .values = info.kind == lancer_oiio_bytes      ? bytes
                      : info.kind == lancer_oiio_integers ? integers
                                                          : floats,
            .decoder_bytes = start.header ? start.header->decoder_bytes : 0};
}

Raster read_with_oiio(InputFile& file, const std::string& format)
{
    const Start start = read_start(file, format);
    OpenPicture open_picture = open(file, format);
    LancerOiioInfo& info = open_picture.info;
    check_size(file, info.width, info.height);
    if (const auto& r = start.radiance; r && !r->fits(info.width, info.height))
        throw file.invalid("not a valid hdr file: its size is not read");
    Raster raster = {.width = static_cast<uint32_t>(info.width),
                     .height = static_cast<uint32_t>(info.height),
                     .channels = static_cast<uint32_t>(info.channels),
                     .bytes = {},
                     .floats = {},
                     .is_float = info.kind == lancer_oiio_floats};
    const auto read = [&](int32_t y0, int32_t y1, void* values) {
        return module().read_rows(open_picture.picture.get(), y0, y1, values, &info) != 0;
    };
    const bool done =
        info.kind == lancer_oiio_bytes ? read_rows(raster.bytes, info, read) : read_rows(raster.floats, info, read);
    if (!done) throw broken(file, format, info);
    if (info.is_damaged) raster.damage = info.message;
    if (info.is_associated) divide_by_alpha(raster);
    if (start.radiance) apply_radiance_header(*start.radiance, raster);
    return raster;
}

}  // namespace lancer
