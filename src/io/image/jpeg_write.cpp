// As in jpeg.cpp, whatever has a destructor lives in the callers of the function that calls setjmp.
#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>  // jpeglib.h wants it
#include <cstdlib>
#include <string>
#include <vector>

#include <jpeglib.h>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/image/jpeg.h"

namespace lancer {
namespace {

struct JpegWriter {
    jpeg_error_mgr errors;  // first: libjpeg hands out its address
    std::jmp_buf out;
    std::array<char, JMSG_LENGTH_MAX> message = {};
    jpeg_compress_struct jpeg = {};
    unsigned char* bytes = nullptr;  // the file, from malloc
    unsigned long size = 0;

    JpegWriter();
    JpegWriter(const JpegWriter&) = delete;
    JpegWriter& operator=(const JpegWriter&) = delete;
    ~JpegWriter()
    {
        jpeg_destroy_compress(&jpeg);
        std::free(bytes);
    }
};

[[noreturn]] void stop_writing(j_common_ptr jpeg)
{
    JpegWriter& w = *reinterpret_cast<JpegWriter*>(jpeg->err);
    w.errors.format_message(jpeg, w.message.data());
    std::longjmp(w.out, 1);
}

JpegWriter::JpegWriter()
{
    jpeg.err = jpeg_std_error(&errors);
    errors.error_exit = stop_writing;
    errors.emit_message = [](j_common_ptr, int) {};
}

struct Comment {
    const unsigned char* text;
    unsigned size;
};

// rows: three bytes for each pixel. False after an error; what it is stands in the message.
bool encode(JpegWriter& w, const Window& data, int quality, const Comment* comments, size_t count,
            const unsigned char* rows)
{
    if (setjmp(w.out)) return false;
    jpeg_create_compress(&w.jpeg);
    jpeg_mem_dest(&w.jpeg, &w.bytes, &w.size);
    w.jpeg.image_width = static_cast<JDIMENSION>(data.width());
    w.jpeg.image_height = static_cast<JDIMENSION>(data.height());
    w.jpeg.input_components = 3;
    w.jpeg.in_color_space = JCS_RGB;
    jpeg_set_defaults(&w.jpeg);
    jpeg_set_quality(&w.jpeg, quality, TRUE);
    w.jpeg.optimize_coding = TRUE;
    // Else colours have half the resolution.
    w.jpeg.comp_info[0].h_samp_factor = w.jpeg.comp_info[0].v_samp_factor = 1;
    jpeg_start_compress(&w.jpeg, TRUE);
    for (size_t i = 0; i < count; ++i) jpeg_write_marker(&w.jpeg, JPEG_COM, comments[i].text, comments[i].size);
    const size_t row = 3 * static_cast<size_t>(data.width());
    while (w.jpeg.next_scanline < w.jpeg.image_height) {
        auto* at = const_cast<unsigned char*>(rows + row * w.jpeg.next_scanline);  // libjpeg only reads it
        jpeg_write_scanlines(&w.jpeg, &at, 1);
    }
    jpeg_finish_compress(&w.jpeg);
    return true;
}

}  // namespace

void write_jpeg(AtomicFile& file, const Image& image, const Metadata& metadata, const ByteOptions& options, int quality)
{
    if (image.data.empty() || image.pixels.size() != image.data.area())
        throw Error(ErrorKind::failed, {file.path()}, "cannot write a picture without pixels");
    constexpr size_t longest = 65533;  // of a comment
    std::vector<std::string> texts;
    for (const auto& [name, value] : metadata)
        texts.push_back(("lancer:" + name + " " + to_string(value)).substr(0, longest));
    std::vector<Comment> comments;
    for (const std::string& text : texts)
        comments.push_back({reinterpret_cast<const unsigned char*>(text.data()), static_cast<unsigned>(text.size())});
    const std::vector<uint8_t> bytes = to_bytes(image, options);
    JpegWriter writer;
    if (!encode(writer, image.data, quality, comments.data(), comments.size(), bytes.data()))
        throw Error(ErrorKind::failed, {file.path()}, std::string("cannot write: ") + writer.message.data());
    file.write(writer.bytes, writer.size);
}

}  // namespace lancer
