#include "io/image/read.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <memory>
#include <new>
#include <string_view>

#include "io/image/exr.h"
#include "io/image/jpeg.h"
#include "io/image/oiio_reader.h"
#include "io/image/png.h"
#include "io/image/radiance.h"
#include "io/image/sizes.h"
#include "io/image/tga.h"
#include "io/input_file.h"

namespace lancer {
namespace {

using std::string_view_literals::operator""sv;

struct Signature {
    std::string_view bytes;
    const char* format;  // as OpenImageIO calls its decoders
};

constexpr Signature signatures[] = {
    {"\x76\x2f\x31\x01"sv, "openexr"},
    {"\x89PNG\r\n\x1a\n"sv, "png"},
    {"\xff\xd8\xff"sv, "jpeg"},
    {"II*\0"sv, "tiff"},
    {"MM\0*"sv, "tiff"},
    {"II+\0"sv, "tiff"},
    {"MM\0+"sv, "tiff"},
    {"#?"sv, "hdr"},
    {"BM"sv, "bmp"},
    {"GIF87a"sv, "gif"},
    {"GIF89a"sv, "gif"},
    {"DDS "sv, "dds"},
};

bool is_webp(std::string_view start) { return start.starts_with("RIFF") && start.substr(8) == "WEBP"; }

bool is_pnm(std::string_view start)
{
    return start.size() >= 3 && start[0] == 'P' &&
           std::string_view("123456Ff").find(start[1]) != std::string_view::npos &&
           std::isspace(static_cast<unsigned char>(start[2]));
}

bool ends_in_tga(const std::string& path)
{
    std::string end = path.substr(path.size() - std::min<size_t>(path.size(), 4));
    std::transform(end.begin(), end.end(), end.begin(), [](unsigned char c) { return std::tolower(c); });
    return end == ".tga";
}

std::string find_format(InputFile& file)
{
    std::array<char, 12> bytes = {};
    const std::string_view start(bytes.data(), file.read(bytes.data(), bytes.size()));
    for (const Signature& s : signatures) {
        if (start.starts_with(s.bytes)) return s.format;
    }
    if (is_pnm(start)) return "pnm";
    if (start.size() == bytes.size() && is_webp(start)) return "webp";
    if (ends_in_tga(file.path())) return "targa";
    throw file.invalid(
        "not a picture of a known format (EXR, PNG, JPEG, TIFF, HDR, WebP, DDS, GIF, BMP, PNM, PFM, or TGA by its "
        "name)");
}

Raster read_format(InputFile& file, const std::string& format)
{
    if (format == "openexr") return read_exr_raster(file.path());
    if (format == "png") return read_png_raster(file.path());
    if (format == "targa") return read_tga(file.path());
    if (format == "jpeg")
        if (auto raster = read_jpeg(file)) return std::move(*raster);
    return read_with_oiio(file, format);
}

RasterHeader read_header(InputFile& file, const std::string& format)
{
    if (format == "openexr") return read_exr_raster_header(file.path());
    if (format == "png") return read_png_raster_header(file.path());
    if (format == "targa") return read_tga_header(file.path());
    if (format == "jpeg") return read_jpeg_size(file);
    return read_header_with_oiio(file, format);
}

}  // namespace

std::shared_ptr<const Raster> read_raster(const std::string& path)
{
    InputFile file(path);
    const std::string format = find_format(file);
    try {
        return std::make_shared<const Raster>(read_format(file, format));
    } catch (const std::bad_alloc&) {
        throw Error(ErrorKind::failed, {path}, "not enough memory to read the picture");
    }
}

RasterHeader read_raster_header(const std::string& path)
{
    InputFile file(path);
    return read_header(file, find_format(file));
}

Metadata read_picture_metadata(const std::string& path)
{
    InputFile file(path);
    const std::string format = find_format(file);
    if (format == "openexr") return read_exr_info(path).metadata;
    if (format == "png") return read_png_info(path).metadata;
    if (format == "jpeg") return read_jpeg_metadata(file);
    if (format == "hdr") return read_radiance_header(file).metadata;
    return {};
}

Image read_image(const std::string& path, Encoding encoding, PictureKind* kind)
{
    InputFile file(path);
    const std::string format = find_format(file);
    if (kind) *kind = {format, true};
    if (format == "openexr") return read_exr(path);
    const Raster raster = read_format(file, format);
    if (!raster.damage.empty()) throw file.invalid("not a valid " + format + " file: " + raster.damage);
    if (kind) kind->is_float = raster.is_float;
    return to_image(raster, encoding);
}

}  // namespace lancer
