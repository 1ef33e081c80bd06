#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfCompression.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfTileDescription.h>
#include <ImfTiledOutputFile.h>
#include <ImfTiledOutputPart.h>
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

// f(first row, one after the last, their pixels): all rows in order, so many at once.
template <class F>
void for_rows(const ImageRows& image, int32_t at_once, const F& f)
{
    const Window& data = image.data;
    const auto width = static_cast<size_t>(data.width());
    std::vector<Color> pixels(width * static_cast<size_t>(std::min(at_once, data.height())));
    for (int32_t y0 = data.y0; y0 < data.y1; y0 += at_once) {
        const int32_t y1 = std::min(y0 + at_once, data.y1);
        for (int32_t y = y0; y < y1; ++y)
            image.fill(y, std::span(pixels).subspan(static_cast<size_t>(y - y0) * width, width));
        f(y0, y1, std::span(pixels).first(static_cast<size_t>(y1 - y0) * width));
    }
}

bool fits_half(const ImageRows& image)
{
    const auto fits = [](float v) { return !std::isfinite(v) || std::abs(v) <= 65504.0f; };
    bool all = true;
    for_rows(image, rows_at_once, [&](int32_t, int32_t, std::span<const Color> pixels) {
        all = all &&
              std::all_of(pixels.begin(), pixels.end(), [&](Color c) { return fits(c.r) && fits(c.g) && fits(c.b); });
    });
    return all;
}

Imf::Chromaticities to_attribute(const Chromaticities& c)
{
    const auto point = [](const std::array<double, 2>& xy) {
        return Imath::V2f(static_cast<float>(xy[0]), static_cast<float>(xy[1]));
    };
    return {point(c[0]), point(c[1]), point(c[2]), point(c[3])};
}

Imath::M44f to_matrix(const ExrCamera::Matrix& rows)
{
    Imath::M44f m;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) m[i][j] = rows[static_cast<size_t>(i)][static_cast<size_t>(j)];
    return m;
}

// A part of the file: the planes of a layer, and in the first one the colours.
struct Part {
    std::string name;
    std::vector<const ImagePlane*> planes;
    bool has_colors = false;
};

std::vector<Part> parts_of(std::span<const ImagePlane> planes, bool is_multipart)
{
    constexpr const char* first = "rgba";
    std::vector<Part> parts{{.name = first, .planes = {}, .has_colors = true}};
    for (const ImagePlane& plane : planes) {
        const size_t dot = plane.name.rfind('.');
        const std::string layer = is_multipart && dot != std::string::npos ? plane.name.substr(0, dot) : first;
        auto part = std::find_if(parts.begin(), parts.end(), [&](const Part& p) { return p.name == layer; });
        if (part == parts.end()) part = parts.insert(parts.end(), {.name = layer, .planes = {}});
        part->planes.push_back(&plane);
    }
    return parts;
}

// What is written, and how.
struct Picture {
    const ImageRows& rows;
    const ExrOptions& options;
    Imf::PixelType type;  // of colours

    int32_t rows_at_once() const { return options.tile ? static_cast<int32_t>(options.tile) : lancer::rows_at_once; }
};

Imf::Header header_of(const Picture& picture, const Part& part)
{
    const ExrOptions& options = picture.options;
    Imf::Header header(to_box(picture.rows.display), to_box(picture.rows.data));
    header.compression() = compressions[static_cast<size_t>(options.compression)];
    Imf::addChromaticities(header, to_attribute(chromaticities_of(options.space)));
    if (options.camera) {
        Imf::addWorldToCamera(header, to_matrix(options.camera->world_to_camera));
        Imf::addWorldToNDC(header, to_matrix(options.camera->world_to_ndc));
    }
    if (options.tile) header.setTileDescription({options.tile, options.tile, Imf::ONE_LEVEL});
    if (options.is_multipart) {
        header.setName(part.name);
        header.setType(options.tile ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
    }
    if (part.has_colors)
        for (const char* name : channel_names) header.channels().insert(name, Imf::Channel(picture.type));
    for (const ImagePlane* plane : part.planes) header.channels().insert(plane->name, Imf::Channel(Imf::FLOAT));
    return header;
}

// write(buffer, first row, one after the last): all rows of a part in order.
template <class Write>
void for_buffers(const Picture& picture, const Part& part, const Write& write)
{
    const Window& data = picture.rows.data;
    const auto width = static_cast<size_t>(data.width());
    const auto with_planes = [&](Imf::FrameBuffer buffer, int32_t y0, int32_t y1) {
        const Imath::Box2i box = {{data.x0, y0}, {data.x1 - 1, y1 - 1}};
        for (const ImagePlane* plane : part.planes) {
            const float* const first = &plane->values[static_cast<size_t>(y0 - data.y0) * width];
            buffer.insert(plane->name, Imf::Slice::Make(Imf::FLOAT, reinterpret_cast<const char*>(first), box,
                                                        sizeof(float), sizeof(float) * width));
        }
        write(buffer, y0, y1);
    };
    if (!part.has_colors) {
        for (int32_t y0 = data.y0; y0 < data.y1; y0 += picture.rows_at_once())
            with_planes({}, y0, std::min(y0 + picture.rows_at_once(), data.y1));
        return;
    }
    const bool as_half = picture.type == Imf::HALF;
    const size_t value_size = as_half ? sizeof(half) : sizeof(float);
    std::vector<half> halves;
    for_rows(picture.rows, picture.rows_at_once(), [&](int32_t y0, int32_t y1, std::span<const Color> pixels) {
        const char* values = reinterpret_cast<const char*>(pixels.data());
        if (as_half) {
            halves.clear();
            for (const Color c : pixels) halves.insert(halves.end(), {half(c.r), half(c.g), half(c.b)});
            values = reinterpret_cast<const char*>(halves.data());
        }
        const Imath::Box2i box = {{data.x0, y0}, {data.x1 - 1, y1 - 1}};
        Imf::FrameBuffer buffer;
        for (size_t c = 0; c < 3; ++c)
            buffer.insert(channel_names[c], Imf::Slice::Make(picture.type, values + c * value_size, box, 3 * value_size,
                                                             3 * value_size * width));
        with_planes(std::move(buffer), y0, y1);
    });
}

template <class Output>
void write_scan_lines(Output&& output, const Picture& picture, const Part& part)
{
    for_buffers(picture, part, [&](const Imf::FrameBuffer& buffer, int32_t y0, int32_t y1) {
        output.setFrameBuffer(buffer);
        output.writePixels(y1 - y0);
    });
}

template <class Output>
void write_tiles(Output&& output, const Picture& picture, const Part& part)
{
    for_buffers(picture, part, [&](const Imf::FrameBuffer& buffer, int32_t y0, int32_t) {
        const int row = (y0 - picture.rows.data.y0) / picture.rows_at_once();
        output.setFrameBuffer(buffer);
        output.writeTiles(0, output.numXTiles() - 1, row, row);
    });
}

void write_parts(Imf::OStream& stream, const Picture& picture, const std::vector<Part>& parts,
                 const std::vector<Imf::Header>& headers)
{
    const bool has_tiles = picture.options.tile > 0;
    if (!picture.options.is_multipart) {
        if (has_tiles) return write_tiles(Imf::TiledOutputFile(stream, headers[0], 0), picture, parts[0]);
        return write_scan_lines(Imf::OutputFile(stream, headers[0], 0), picture, parts[0]);
    }
    Imf::MultiPartOutputFile file(stream, headers.data(), static_cast<int>(headers.size()), false, 0);
    for (size_t i = 0; i < parts.size(); ++i) {
        if (has_tiles)
            write_tiles(Imf::TiledOutputPart(file, static_cast<int>(i)), picture, parts[i]);
        else
            write_scan_lines(Imf::OutputPart(file, static_cast<int>(i)), picture, parts[i]);
    }
}

}  // namespace

ImageRows rows_of(const Image& image)
{
    if (image.pixels.size() != (image.data.empty() ? 0 : image.data.area())) return {};
    return {image.display, image.data, [&image](int32_t y, std::span<Color> row) {
                std::copy_n(&image.at(image.data.x0, y), row.size(), row.begin());
            }};
}

namespace {

// The same picture in a color space.
ImageRows converted(const ImageRows& image, const ColorMatrix& to)
{
    ImageRows rows = image;
    rows.fill = [fill = image.fill, to](int32_t y, std::span<Color> row) {
        fill(y, row);
        for (Color& c : row) c = transformed(to, c);
    };
    return rows;
}

std::vector<ImagePlane> converted(std::span<const ImagePlane> planes, const ColorMatrix& to)
{
    std::vector<ImagePlane> all(planes.begin(), planes.end());
    const auto find = [&](const std::string& name) {
        return std::find_if(all.begin(), all.end(), [&](const ImagePlane& p) { return p.name == name; });
    };
    for (ImagePlane& red : all) {
        if (!red.name.ends_with(".R") || red.name.starts_with("Crypto")) continue;
        const std::string layer = red.name.substr(0, red.name.size() - 1);
        const auto green = find(layer + "G"), blue = find(layer + "B");
        if (green == all.end() || blue == all.end()) continue;
        for (size_t i = 0; i < red.values.size(); ++i) {
            const Color c = transformed(to, {red.values[i], green->values[i], blue->values[i]});
            red.values[i] = c.r, green->values[i] = c.g, blue->values[i] = c.b;
        }
    }
    return all;
}

// Colours are in the color space of the options already.
void write_in_space(AtomicFile& file, const ImageRows& image, const Metadata& metadata, const ExrOptions& options,
                    std::span<const ImagePlane> planes)
{
    const Picture picture{image, options, options.half && fits_half(image) ? Imf::HALF : Imf::FLOAT};
    const std::vector<Part> parts = parts_of(planes, options.is_multipart);
    try {
        std::vector<Imf::Header> headers;
        for (const Part& part : parts) headers.push_back(header_of(picture, part));
        headers[0].insert("software", Imf::StringAttribute("lancer"));
        add_metadata(headers[0], metadata);
        // Programs look for them where the layers are that they tell of.
        for (Imf::Header& header : headers)
            if (&header == headers.data() || (header.hasName() && header.name().starts_with("Crypto")))
                for (const auto& [name, text] : options.attributes) header.insert(name, Imf::StringAttribute(text));
        FileOut stream(file);
        write_parts(stream, picture, parts, headers);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& e) {
        throw Error(ErrorKind::failed, {file.path()}, std::string("cannot write: ") + e.what());
    }
}

}  // namespace

void write_exr(AtomicFile& file, const ImageRows& image, const Metadata& metadata, const ExrOptions& options,
               std::span<const ImagePlane> planes)
{
    if (image.data.empty() || image.display.empty())
        throw Error(ErrorKind::failed, {file.path()}, "cannot write a picture without pixels");
    if (options.space != ColorSpace::lin_rec709) {
        const ColorMatrix to = to_space(options.space);
        const std::vector<ImagePlane> in_space = converted(planes, to);
        return write_in_space(file, converted(image, to), metadata, options, in_space);
    }
    write_in_space(file, image, metadata, options, planes);
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
