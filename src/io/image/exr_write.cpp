#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfCompression.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <half.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/image/exr.h"

namespace lancer {
namespace {

constexpr const char* channel_names[] = {"R", "G", "B"};
constexpr int32_t rows_at_once = 256;  // whole blocks of any compression

class FileOut : public Imf::OStream {
public:
    explicit FileOut(AtomicFile& file) : OStream(file.path().c_str()), file_(file) {}
    void write(const char bytes[], int count) override { file_.write(bytes, static_cast<size_t>(count)); }
    uint64_t tellp() override { return file_.tell(); }
    void seekp(uint64_t position) override { file_.seek(position); }

private:
    AtomicFile& file_;
};

// Of the enumerator in the order of ExrCompression.
constexpr std::array compressions{Imf::NO_COMPRESSION,  Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION,
                                  Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::DWAA_COMPRESSION,
                                  Imf::DWAB_COMPRESSION};
static_assert(compressions.size() == enum_names<ExrCompression>.size());

Imath::Box2i to_box(const Window& w) { return {{w.x0, w.y0}, {w.x1 - 1, w.y1 - 1}}; }

void add_metadata(Imf::Header& header, const Metadata& metadata)
{
    for (const auto& [name, value] : metadata) {
        const std::string full = std::string(exr_prefix) + name;
        const auto* integer = std::get_if<int64_t>(&value);
        if (const auto* real = std::get_if<double>(&value)) {
            header.insert(full, Imf::DoubleAttribute(*real));
        } else if (integer && *integer == static_cast<int32_t>(*integer)) {
            header.insert(full, Imf::IntAttribute(static_cast<int32_t>(*integer)));
        } else {
            header.insert(full, Imf::StringAttribute(to_string(value)));
        }
    }
}

// f(first row, one after the last, their pixels): all rows in order.
template <class F>
void for_rows(const ImageRows& image, const F& f)
{
    const Window& data = image.data;
    const auto width = static_cast<size_t>(data.width());
    std::vector<Color> pixels(width * static_cast<size_t>(std::min(rows_at_once, data.height())));
    for (int32_t y0 = data.y0; y0 < data.y1; y0 += rows_at_once) {
        const int32_t y1 = std::min(y0 + rows_at_once, data.y1);
        for (int32_t y = y0; y < y1; ++y)
            image.fill(y, std::span(pixels).subspan(static_cast<size_t>(y - y0) * width, width));
        f(y0, y1, std::span(pixels).first(static_cast<size_t>(y1 - y0) * width));
    }
}

bool fits_half(const ImageRows& image)
{
    const auto fits = [](float v) { return !std::isfinite(v) || std::abs(v) <= 65504.0f; };
    bool all = true;
    for_rows(image, [&](int32_t, int32_t, std::span<const Color> pixels) {
        all = all &&
              std::all_of(pixels.begin(), pixels.end(), [&](Color c) { return fits(c.r) && fits(c.g) && fits(c.b); });
    });
    return all;
}

}  // namespace

ImageRows rows_of(const Image& image)
{
    if (image.pixels.size() != (image.data.empty() ? 0 : image.data.area())) return {};
    return {image.display, image.data, [&image](int32_t y, std::span<Color> row) {
                std::copy_n(&image.at(image.data.x0, y), row.size(), row.begin());
            }};
}

void write_exr(AtomicFile& file, const ImageRows& image, const Metadata& metadata, const ExrOptions& options,
               std::span<const ImagePlane> planes)
{
    if (image.data.empty() || image.display.empty())
        throw Error(ErrorKind::failed, {file.path()}, "cannot write a picture without pixels");
    const bool as_half = options.half && fits_half(image);
    const size_t value_size = as_half ? sizeof(half) : sizeof(float);
    const auto width = static_cast<size_t>(image.data.width());
    const Imf::PixelType type = as_half ? Imf::HALF : Imf::FLOAT;
    try {
        Imf::Header header(to_box(image.display), to_box(image.data));
        header.compression() = compressions[static_cast<size_t>(options.compression)];
        Imf::addChromaticities(header, Imf::Chromaticities());  // its default is Rec. 709
        header.insert("software", Imf::StringAttribute("lancer"));
        add_metadata(header, metadata);
        for (const auto& [name, text] : options.attributes) header.insert(name, Imf::StringAttribute(text));
        for (const char* name : channel_names) header.channels().insert(name, Imf::Channel(type));
        for (const ImagePlane& plane : planes) header.channels().insert(plane.name, Imf::Channel(Imf::FLOAT));
        FileOut stream(file);
        Imf::OutputFile output(stream, header, 0);
        std::vector<half> halves;
        for_rows(image, [&](int32_t y0, int32_t y1, std::span<const Color> pixels) {
            const char* values = reinterpret_cast<const char*>(pixels.data());
            if (as_half) {
                halves.clear();
                for (const Color c : pixels) halves.insert(halves.end(), {half(c.r), half(c.g), half(c.b)});
                values = reinterpret_cast<const char*>(halves.data());
            }
            const Imath::Box2i box = {{image.data.x0, y0}, {image.data.x1 - 1, y1 - 1}};
            Imf::FrameBuffer buffer;
            for (size_t c = 0; c < 3; ++c)
                buffer.insert(channel_names[c], Imf::Slice::Make(type, values + c * value_size, box, 3 * value_size,
                                                                 3 * value_size * width));
            for (const ImagePlane& plane : planes) {
                const float* const first = &plane.values[static_cast<size_t>(y0 - image.data.y0) * width];
                buffer.insert(plane.name, Imf::Slice::Make(Imf::FLOAT, reinterpret_cast<const char*>(first), box,
                                                           sizeof(float), sizeof(float) * width));
            }
            output.setFrameBuffer(buffer);
            output.writePixels(y1 - y0);
        });
    } catch (const Error&) {
        throw;
    } catch (const std::exception& e) {
        throw Error(ErrorKind::failed, {file.path()}, std::string("cannot write: ") + e.what());
    }
}

float through_half(float x) { return half(x); }

void write_exr(const std::string& path, const Image& image, const Metadata& metadata, const ExrOptions& options,
               std::span<const ImagePlane> planes)
{
    AtomicFile file(path);
    write_exr(file, rows_of(image), metadata, options, planes);
    file.commit();
}

}  // namespace lancer
