#include "io/image/read.h"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <memory>
#include <new>
#include <string_view>

#include "io/image/exr.h"
#include "io/image/jpeg.h"
#include "io/image/oiio_module.h"
#include "io/image/png.h"
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
};

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
    std::array<char, 8> bytes = {};
    const std::string_view start(bytes.data(), file.read(bytes.data(), bytes.size()));
    for (const Signature& s : signatures) {
        if (start.starts_with(s.bytes)) return s.format;
    }
    if (is_pnm(start)) return "pnm";
    if (ends_in_tga(file.path())) return "targa";
    throw file.invalid(
        "not a picture of a known format (EXR, PNG, JPEG, TIFF, HDR, BMP, PNM, PFM, or TGA by its name)");
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

struct Module {
    decltype(&lancer_oiio_open) open;
    decltype(&lancer_oiio_read_rows) read_rows;
    decltype(&lancer_oiio_close) close;
};

template <class Function>
void find_symbol(void* library, const char* name, Function& function)
{
    function = reinterpret_cast<Function>(dlsym(library, name));
    if (!function) throw Error(ErrorKind::failed, std::string("error: lancer_oiio.so lacks ") + name);
}

// Beside the program (a build folder), one up (test programs) or in ../lib/lancer (installed). Never closed again: the
// libraries behind it do not survive that.
Module load_module()
{
    std::error_code unknown;
    const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
    std::string tried;
    for (const char* place : {"lancer_oiio.so", "../lancer_oiio.so", "../lib/lancer/lancer_oiio.so"}) {
        const std::string path = (folder / place).lexically_normal();
        tried += (tried.empty() ? "" : ", ") + path;
        if (!std::filesystem::exists(path, unknown)) continue;
        void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (!library)
            throw Error(ErrorKind::failed, std::string("error: cannot open the picture module: ") + dlerror());
        decltype(&lancer_oiio_version) version = nullptr;
        find_symbol(library, "lancer_oiio_version", version);
        if (version() != lancer_oiio_current_version) {
            throw Error(ErrorKind::failed, {path}, "is of another build of lancer; build the target lancer_oiio again");
        }
        Module m = {};
        find_symbol(library, "lancer_oiio_open", m.open);
        find_symbol(library, "lancer_oiio_read_rows", m.read_rows);
        find_symbol(library, "lancer_oiio_close", m.close);
        return m;
    }
    throw Error(
        ErrorKind::failed,
        "error: lancer_oiio.so, which reads pictures other than EXR, PNG, JPEG and TGA, is missing; build the target "
        "lancer_oiio (it needs libopenimageio-dev) or convert the pictures. Looked for: " +
            tried);
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

Raster read_with_module(const InputFile& file, const std::string& format)
{
    static const Module module = load_module();  // a failure is tried again next time
    LancerOiioInfo info = {};
    const std::unique_ptr<LancerOiioPicture, decltype(module.close)> picture(
        module.open(file.path().c_str(), format.c_str(), &info), module.close);
    const auto broken = [&] { return file.invalid("not a valid " + format + " file: " + info.message); };
    if (!picture) throw broken();
    const std::string size = std::to_string(info.width) + " x " + std::to_string(info.height);
    if (info.width <= 0 || info.height <= 0) throw file.invalid("the picture is " + size + " pixels");
    if (info.width > max_image_side || info.height > max_image_side ||
        int64_t{info.width} * info.height > max_image_pixels) {
        throw file.invalid("picture too large: " + size + " pixels");
    }
    Raster raster = {.width = static_cast<uint32_t>(info.width),
                     .height = static_cast<uint32_t>(info.height),
                     .channels = static_cast<uint32_t>(info.channels),
                     .bytes = {},
                     .floats = {},
                     .is_float = info.kind == lancer_oiio_floats};
    const auto read = [&](int32_t y0, int32_t y1, void* values) {
        return module.read_rows(picture.get(), y0, y1, values, &info) != 0;
    };
    const bool done =
        info.kind == lancer_oiio_bytes ? read_rows(raster.bytes, info, read) : read_rows(raster.floats, info, read);
    if (!done) throw broken();
    if (info.is_damaged) raster.damage = info.message;
    return raster;
}

Raster read_format(InputFile& file, const std::string& format)
{
    if (format == "openexr") return read_exr_raster(file.path());
    if (format == "png") return read_png_raster(file.path());
    if (format == "targa") return read_tga(file.path());
    if (format == "jpeg")
        if (auto raster = read_jpeg(file)) return std::move(*raster);
    if (format == "bmp") check_bmp(file);
    return read_with_module(file, format);
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
