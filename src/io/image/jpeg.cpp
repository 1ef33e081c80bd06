// libjpeg reports errors by whatever error_exit does, which must not return: a longjmp. So that no destructor is jumped
// over, everything with a destructor lives in the callers of the functions that call setjmp.
#include "io/image/jpeg.h"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>  // jpeglib.h wants it
#include <string>
#include <vector>

#include <jpeglib.h>

namespace lancer {
namespace {

struct JpegReader {
    jpeg_error_mgr errors;  // first: libjpeg hands out its address
    std::jmp_buf out;
    std::array<char, JMSG_LENGTH_MAX> message = {};  // of the first error or warning
    jpeg_decompress_struct jpeg = {};

    JpegReader();
    JpegReader(const JpegReader&) = delete;
    JpegReader& operator=(const JpegReader&) = delete;
    ~JpegReader() { jpeg_destroy_decompress(&jpeg); }
};

JpegReader& reader_of(j_common_ptr jpeg) { return *reinterpret_cast<JpegReader*>(jpeg->err); }

[[noreturn]] void stop_reading(j_common_ptr jpeg)
{
    JpegReader& r = reader_of(jpeg);
    if (r.message[0] == 0) r.errors.format_message(jpeg, r.message.data());
    std::longjmp(r.out, 1);
}

// Negative levels are warnings about broken files that can still be read, for example truncated ones; others are
// traces.
void on_message(j_common_ptr jpeg, int level)
{
    JpegReader& r = reader_of(jpeg);
    if (level >= 0) return;
    ++r.errors.num_warnings;
    if (r.message[0] == 0) r.errors.format_message(jpeg, r.message.data());
}

JpegReader::JpegReader()
{
    jpeg.err = jpeg_std_error(&errors);
    errors.error_exit = stop_reading;
    errors.emit_message = on_message;
}

// Each false after an error; what it is stands in the message.
bool read_header(JpegReader& r, const std::vector<unsigned char>& bytes)
{
    if (setjmp(r.out)) return false;
    jpeg_create_decompress(&r.jpeg);
    jpeg_mem_src(&r.jpeg, bytes.data(), bytes.size());
    jpeg_read_header(&r.jpeg, TRUE);
    return true;
}
bool read_comments(JpegReader& r, const std::vector<unsigned char>& bytes)
{
    if (setjmp(r.out)) return false;
    jpeg_create_decompress(&r.jpeg);
    jpeg_save_markers(&r.jpeg, JPEG_COM, 0xffff);
    jpeg_mem_src(&r.jpeg, bytes.data(), bytes.size());
    jpeg_read_header(&r.jpeg, TRUE);
    return true;
}
bool start(JpegReader& r)
{
    if (setjmp(r.out)) return false;
    jpeg_start_decompress(&r.jpeg);
    return true;
}
bool read_row(JpegReader& r, unsigned char* row)
{
    if (setjmp(r.out)) return false;
    return jpeg_read_scanlines(&r.jpeg, &row, 1) == 1;
}
bool finish(JpegReader& r)
{
    if (setjmp(r.out)) return false;
    return jpeg_finish_decompress(&r.jpeg) == TRUE;
}

Error broken(const InputFile& file, const JpegReader& r)
{
    return file.invalid("not a valid jpeg file: " + std::string(r.message[0] ? r.message.data() : "damaged"));
}

std::vector<unsigned char> read_all(InputFile& file)
{
    std::vector<unsigned char> stored(file.size());
    file.seek(0);
    stored.resize(file.read(stored.data(), stored.size()));
    return stored;
}

}  // namespace

Metadata read_jpeg_metadata(InputFile& file)
{
    JpegReader r;
    if (!read_comments(r, read_all(file))) throw broken(file, r);
    Metadata metadata;
    for (const jpeg_marker_struct* m = r.jpeg.marker_list; m; m = m->next) {
        const std::string text(reinterpret_cast<const char*>(m->data), m->data_length), prefix = "lancer:";
        const size_t blank = text.find(' ');
        if (text.starts_with(prefix) && blank != std::string::npos)
            metadata.emplace_back(text.substr(prefix.size(), blank - prefix.size()), text.substr(blank + 1));
    }
    return metadata;
}

std::optional<Raster> read_jpeg(InputFile& file)
{
    JpegReader r;
    const std::vector<unsigned char> stored = read_all(file);
    if (!read_header(r, stored)) throw broken(file, r);
    if (r.jpeg.num_components != 1 && r.jpeg.num_components != 3) return {};
    const uint32_t width = r.jpeg.image_width, height = r.jpeg.image_height;
    if (int64_t{width} * height > max_image_pixels) {
        throw file.invalid("picture too large: " + std::to_string(width) + " x " + std::to_string(height) + " pixels");
    }
    if (!start(r)) throw broken(file, r);
    Raster raster = {.width = width,
                     .height = height,
                     .channels = static_cast<uint32_t>(r.jpeg.output_components),
                     .bytes = {},
                     .floats = {}};
    const size_t row = size_t{width} * raster.channels;
    raster.bytes.reserve(row * height);  // costs nothing until it is filled, which is as far as the file has rows
    constexpr uint8_t grey = 128;        // as libjpeg gives blocks that it has not got
    // A picture of one colour takes a byte for 4000 pixels at least: a few bytes must not become a wall of grey.
    constexpr uint64_t most_pixels_per_byte = 4096;
    const uint64_t pixels = uint64_t{width} * height;
    uint32_t y = 0;
    for (bool is_there = true; is_there && y < height; y += is_there) {
        raster.bytes.resize(row * (y + 1), grey);
        is_there = read_row(r, &raster.bytes[row * y]);
        if (r.message[0] && pixels / most_pixels_per_byte > stored.size()) throw broken(file, r);
    }
    if (y == 0) throw broken(file, r);
    if (y == height) finish(r);
    raster.bytes.resize(row * height, grey);
    raster.damage = r.message.data();
    return raster;
}

}  // namespace lancer
