// libpng reports errors by longjmp. So that no destructor is jumped over and no exception passes through its C frames:
// everything with a destructor lives in the callers of the functions that call setjmp, those hold plain values only,
// and callbacks keep an exception in the context until libpng has been left.
#include "io/image/png.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <exception>

#include "io/atomic_file.h"
#include "io/input_file.h"

namespace lancer {
namespace {

struct Context {
    AtomicFile* out = nullptr;
    InputFile* in = nullptr;
    std::exception_ptr thrown;
    char message[200] = "";
};

Context& context_of(png_structp png) { return *static_cast<Context*>(png_get_error_ptr(png)); }

[[noreturn]] void on_error(png_structp png, png_const_charp message)
{
    Context& c = context_of(png);
    std::strncpy(c.message, message, sizeof c.message - 1);
    png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void on_write(png_structp png, png_bytep bytes, size_t count)
{
    Context& c = context_of(png);
    try {
        c.out->write(bytes, count);
    } catch (...) {
        c.thrown = std::current_exception();
    }
    if (c.thrown) png_error(png, "write");
}

void on_flush(png_structp) {}

void on_read(png_structp png, png_bytep bytes, size_t count)
{
    if (context_of(png).in->read(bytes, count) != count) png_error(png, "the file ends too early");
}

struct PngWriter {
    Context context;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &context, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    PngWriter() = default;
    PngWriter(const PngWriter&) = delete;
    ~PngWriter() { png_destroy_write_struct(&png, &info); }
};

struct PngReader {
    Context context;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &context, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    PngReader() = default;
    PngReader(const PngReader&) = delete;
    ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
};

// What the code values mean.
enum class PngCodes { srgb, linear, unknown };

bool encode(png_structp png, png_infop info, const Window& data, int color_type, bool crop, PngCodes codes,
            png_textp texts, int text_count, png_bytepp rows)
{
    if (setjmp(png_jmpbuf(png))) return false;
    png_set_write_fn(png, png_get_error_ptr(png), on_write, on_flush);
    png_set_user_limits(png, 0x7fffffff, 0x7fffffff);
    png_set_IHDR(png, info, static_cast<png_uint_32>(data.width()), static_cast<png_uint_32>(data.height()), 8,
                 color_type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (codes == PngCodes::linear) {
        png_set_gAMA(png, info, 1);
    } else if (codes == PngCodes::srgb) {
        png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    }
    if (crop) png_set_oFFs(png, info, data.x0, data.y0, PNG_OFFSET_PIXEL);
    png_set_text(png, info, texts, text_count);
    png_write_info(png, info);
    png_write_image(png, rows);
    png_write_end(png, nullptr);
    return true;
}

// libpng only warns of a chunk that is too long, and then asks for as much memory and fills it before it reads. Looks
// at those that a reader of the header meets. A file that stops between chunks, or is none, is left to libpng.
void check_chunks(InputFile& file)
{
    std::array<png_byte, 8> head = {};  // the signature, then each chunk's length, from its high byte, and name
    const bool is_png = file.read(head.data(), head.size()) == head.size() && png_sig_cmp(head.data(), 0, 8) == 0;
    uint64_t at = head.size();
    constexpr uint64_t check_sum_bytes = 4;
    while (is_png && file.read(head.data(), head.size()) == head.size() && std::memcmp(&head[4], "IDAT", 4) != 0) {
        at += head.size() + png_get_uint_32(head.data()) + check_sum_bytes;
        if (at > file.size()) throw file.invalid("not a valid PNG file: the file ends too early");
        file.seek(at);
    }
    file.seek(0);
}

struct Layout {
    png_uint_32 width = 0, height = 0;
    uint32_t channels = 0;
    int depth = 0, passes = 0;
    float exponent = 0;           // as in Raster
    size_t stored_row_bytes = 0;  // in the file, after decompression
    size_t row_bytes = 0;         // as handed out: channels of 8 or 16 bits
};

// The power that the file gives for the decoding of its colours; 0: none, or about that of sRGB, which is then meant.
// What the specification says of readers without colour profiles (PNG, third edition, 13.13): an sRGB chunk counts
// more than gAMA, which stands in for a profile.
float exponent_of(png_structp png, png_infop info)
{
    png_fixed_point gamma = 0;
    if (png_get_valid(png, info, PNG_INFO_sRGB) || !png_get_gAMA_fixed(png, info, &gamma) || gamma <= 0) return 0;
    constexpr double one = 100000, same = 0.05;  // as far apart libpng takes gammas for the same
    const double exponent = one / gamma;
    return std::abs(exponent / 2.2 - 1) <= same ? 0 : static_cast<float>(exponent);
}

bool decode_header(png_structp png, png_infop info, Layout* layout)
{
    if (setjmp(png_jmpbuf(png))) return false;
    png_set_read_fn(png, png_get_error_ptr(png), on_read);
    png_set_user_limits(png, max_image_side, max_image_side);
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);  // skip all that does not make pixels
    constexpr png_byte gamma_chunks[] = {'g', 'A', 'M', 'A', 0, 's', 'R', 'G', 'B', 0};
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_AS_DEFAULT, gamma_chunks, 2);
    png_read_info(png, info);
    layout->exponent = exponent_of(png, info);
    layout->width = png_get_image_width(png, info);
    layout->height = png_get_image_height(png, info);
    layout->stored_row_bytes = png_get_rowbytes(png, info);
    png_set_expand(png);
    if (png_get_bit_depth(png, info) == 16 && std::endian::native == std::endian::little) png_set_swap(png);
    layout->passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    layout->depth = png_get_bit_depth(png, info);
    layout->row_bytes = png_get_rowbytes(png, info);
    layout->channels = png_get_channels(png, info);
    return true;
}

bool decode_info(png_structp png, png_infop info)
{
    if (setjmp(png_jmpbuf(png))) return false;
    png_set_read_fn(png, png_get_error_ptr(png), on_read);
    png_set_user_limits(png, max_image_side, max_image_side);
    // Compressed texts can be a thousand times longer than the file.
    png_set_chunk_malloc_max(png, 1 << 20);
    png_set_chunk_cache_max(png, 128);
    png_read_info(png, info);
    return true;
}

bool decode_rows(png_structp png, png_bytepp rows)
{
    if (setjmp(png_jmpbuf(png))) return false;
    png_read_image(png, rows);
    png_read_end(png, nullptr);
    return true;
}

template <class Byte>
std::vector<png_bytep> row_pointers(std::vector<Byte>& bytes, size_t row_bytes, size_t rows)
{
    std::vector<png_bytep> result(rows);
    for (size_t y = 0; y < rows; ++y) result[y] = bytes.data() + y * row_bytes;
    return result;
}

// The code values of a picture with alpha, four for each pixel.
std::vector<uint8_t> with_alpha(Image image, std::span<const float> alpha, const ByteOptions& options)
{
    for (size_t i = 0; i < alpha.size(); ++i)
        image.pixels[i] = alpha[i] > 0 ? image.pixels[i] * (1 / alpha[i]) : Color{};
    const std::vector<uint8_t> colors = to_bytes(image, options);
    std::vector<uint8_t> bytes;
    bytes.reserve(4 * alpha.size());
    for (size_t i = 0; i < alpha.size(); ++i) {
        bytes.insert(bytes.end(), &colors[3 * i], &colors[3 * i] + 3);
        bytes.push_back(static_cast<uint8_t>(std::clamp(alpha[i], 0.0f, 1.0f) * 255 + 0.5f));
    }
    return bytes;
}

}  // namespace

void write_png(AtomicFile& file, const Image& image, const Metadata& metadata, const ByteOptions& options,
               std::span<const float> alpha)
{
    if (image.data.empty() || image.pixels.size() != image.data.area())
        throw Error(ErrorKind::failed, {file.path()}, "cannot write a picture without pixels");
    std::vector<std::pair<std::string, std::string>> pairs = {{"Software", "lancer"}};
    for (const auto& [name, value] : metadata) pairs.emplace_back("lancer:" + name, to_string(value));
    std::vector<png_text> texts(pairs.size());
    for (size_t i = 0; i < pairs.size(); ++i) {
        const std::string& text = pairs[i].second;
        const bool ascii = std::all_of(text.begin(), text.end(), [](char c) { return c > 0; });
        texts[i].compression = ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;  // the latter is UTF-8
        texts[i].key = pairs[i].first.data();
        texts[i].text = pairs[i].second.data();
        texts[i].text_length = text.size();
        texts[i].itxt_length = ascii ? 0 : text.size();
    }
    std::vector<uint8_t> bytes = alpha.empty() ? to_bytes(image, options) : with_alpha(image, alpha, options);
    const size_t channels = alpha.empty() ? 3 : 4;
    std::vector<png_bytep> rows = row_pointers(bytes, channels * static_cast<size_t>(image.data.width()),
                                               static_cast<size_t>(image.data.height()));
    const PngCodes codes = options.curve                      ? PngCodes::unknown
                           : options.tonemap == ToneMap::none ? PngCodes::linear
                                                              : PngCodes::srgb;
    PngWriter writer;
    writer.context.out = &file;
    if (!writer.info) throw Error(ErrorKind::failed, {file.path()}, "cannot write: not enough memory");
    const bool done =
        encode(writer.png, writer.info, image.data, alpha.empty() ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA,
               image.data != image.display, codes, texts.data(), static_cast<int>(texts.size()), rows.data());
    if (writer.context.thrown) std::rethrow_exception(writer.context.thrown);
    if (!done) throw Error(ErrorKind::failed, {file.path()}, std::string("cannot write: ") + writer.context.message);
}

void write_png(const std::string& path, const Image& image, const Metadata& metadata, const ByteOptions& options)
{
    AtomicFile file(path);
    write_png(file, image, metadata, options);
    file.commit();
}

namespace {

// Throws for what is no PNG, is too large, or cannot be as large as it says.
Layout read_layout(PngReader& reader, InputFile& file)
{
    reader.context.in = &file;
    if (!reader.info) throw Error(ErrorKind::failed, {file.path()}, "not enough memory to read the picture");
    Layout layout;
    if (!decode_header(reader.png, reader.info, &layout))
        throw file.invalid(std::string("not a valid PNG file: ") + reader.context.message);
    const std::string size = std::to_string(layout.width) + " x " + std::to_string(layout.height);
    if (int64_t{layout.width} * layout.height > max_image_pixels) {
        throw file.invalid("picture too large: " + size + " pixels");
    }
    // The compression of the format shrinks no more than 1032 times; nothing is allocated for a picture that the
    // file cannot hold.
    if (layout.stored_row_bytes * layout.height / 1032 > file.size()) {
        throw file.invalid("the file is too short for a picture of " + size + " pixels");
    }
    return layout;
}

}  // namespace

RasterHeader read_png_raster_header(const std::string& path)
{
    InputFile file(path);
    PngReader reader;
    const Layout layout = read_layout(reader, file);
    const bool is_bytes = layout.depth == 8;
    return {.width = layout.width,
            .height = layout.height,
            .channels = layout.channels,
            .values = is_bytes ? RasterHeader::Values::bytes : RasterHeader::Values::integers,
            .exponent = layout.exponent,
            .decoder_bytes = is_bytes ? 0 : layout.row_bytes * layout.height};
}

Raster read_png_raster(const std::string& path)
{
    InputFile file(path);
    PngReader reader;
    const Layout layout = read_layout(reader, file);
    std::vector<uint8_t> bytes(layout.row_bytes * layout.height);
    std::vector<png_bytep> rows = row_pointers(bytes, layout.row_bytes, layout.height);
    if (!decode_rows(reader.png, rows.data()))
        throw file.invalid(std::string("not a valid PNG file: ") + reader.context.message);
    Raster raster = {.width = layout.width,
                     .height = layout.height,
                     .channels = layout.channels,
                     .bytes = {},
                     .floats = {},
                     .exponent = layout.exponent};
    if (layout.depth == 8) {
        raster.bytes = std::move(bytes);
        return raster;
    }
    raster.floats.resize(raster.value_count());
    for (size_t i = 0; i < raster.floats.size(); ++i) {
        uint16_t v = 0;
        std::memcpy(&v, bytes.data() + i * sizeof v, sizeof v);
        raster.floats[i] = static_cast<float>(v) / 65535;
    }
    return raster;
}

Image read_png(const std::string& path, Encoding encoding) { return to_image(read_png_raster(path), encoding); }

PngInfo read_png_info(const std::string& path)
{
    InputFile file(path);
    check_chunks(file);
    PngReader reader;
    reader.context.in = &file;
    if (!reader.info) throw Error(ErrorKind::failed, {path}, "not enough memory to read the picture");
    if (!decode_info(reader.png, reader.info))
        throw file.invalid("not a valid PNG file: " + std::string(reader.context.message));
    PngInfo info{.width = png_get_image_width(reader.png, reader.info),
                 .height = png_get_image_height(reader.png, reader.info),
                 .bits = png_get_bit_depth(reader.png, reader.info),
                 .channels = png_get_channels(reader.png, reader.info),
                 .metadata = {}};
    png_textp texts = nullptr;
    int count = 0;
    png_get_text(reader.png, reader.info, &texts, &count);
    const std::string prefix = "lancer:";
    for (int i = 0; i < count; ++i) {
        const std::string name = texts[i].key;
        if (name.starts_with(prefix))
            info.metadata.emplace_back(name.substr(prefix.size()), std::string(texts[i].text));
    }
    return info;
}

std::string png_version() { return png_get_libpng_ver(nullptr); }

}  // namespace lancer
