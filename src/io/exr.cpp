#include "io/exr.h"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfDoubleAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <OpenEXRConfig.h>
#include <half.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <new>

#include "io/atomic_file.h"
#include "io/exr_header.h"
#include "io/input_file.h"

namespace lancer {
namespace {

constexpr const char* prefix = "lancer:";
constexpr const char* channel_names[] = {"R", "G", "B"};

class FileOut : public Imf::OStream {
public:
    explicit FileOut(AtomicFile& file) : OStream(file.path().c_str()), file_(file) {}
    void write(const char bytes[], int count) override { file_.write(bytes, static_cast<size_t>(count)); }
    uint64_t tellp() override { return file_.tell(); }
    void seekp(uint64_t position) override { file_.seek(position); }

private:
    AtomicFile& file_;
};

class FileIn : public Imf::IStream {
public:
    explicit FileIn(InputFile& file) : IStream(file.path().c_str()), file_(file) {}
    bool read(char bytes[], int count) override
    {
        if (count < 0 || file_.read(bytes, static_cast<size_t>(count)) != static_cast<size_t>(count)) {
            throw file_.invalid("the file ends too early");
        }
        return file_.tell() < file_.size();
    }
    uint64_t tellg() override { return file_.tell(); }
    void seekg(uint64_t position) override { file_.seek(std::min(position, file_.size())); }
    void clear() override {}

private:
    InputFile& file_;
};

Imath::Box2i to_box(const Window& w) { return {{w.x0, w.y0}, {w.x1 - 1, w.y1 - 1}}; }

Window to_window(const Imath::Box2i& b) { return {b.min.x, b.min.y, b.max.x + 1, b.max.y + 1}; }

bool fits_half(const Image& image)
{
    const auto fits = [](float v) { return !std::isfinite(v) || std::abs(v) <= 65504.0f; };
    return std::all_of(image.pixels.begin(), image.pixels.end(),
                       [&](Color c) { return fits(c.r) && fits(c.g) && fits(c.b); });
}

void add_metadata(Imf::Header& header, const Metadata& metadata)
{
    for (const auto& [name, value] : metadata) {
        const std::string full = prefix + name;
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

Metadata read_metadata(const Imf::Header& header)
{
    Metadata result;
    for (auto i = header.begin(); i != header.end(); ++i) {
        if (std::strncmp(i.name(), prefix, std::strlen(prefix)) != 0) continue;
        const std::string name = i.name() + std::strlen(prefix);
        const Imf::Attribute& a = i.attribute();
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a)) {
            result.emplace_back(name, text->value());
        } else if (const auto* integer = dynamic_cast<const Imf::IntAttribute*>(&a)) {
            result.emplace_back(name, int64_t{integer->value()});
        } else if (const auto* real = dynamic_cast<const Imf::DoubleAttribute*>(&a)) {
            result.emplace_back(name, real->value());
        } else if (const auto* single = dynamic_cast<const Imf::FloatAttribute*>(&a)) {
            result.emplace_back(name, double{single->value()});
        }
    }
    return result;
}

// The channels to read for R, G, B: those, or Y three times. Others in the file are left alone.
std::array<const char*, 3> find_channels(const InputFile& file, const Imf::ChannelList& channels)
{
    const bool color = channels.findChannel("R") && channels.findChannel("G") && channels.findChannel("B");
    if (!color && (!channels.findChannel("Y") || channels.findChannel("RY") || channels.findChannel("BY"))) {
        std::string names;
        for (auto i = channels.begin(); i != channels.end(); ++i)
            names += (names.empty() ? "" : ", ") + std::string(i.name());
        throw file.invalid("needs channels R, G, B, or Y alone; the file has " + names);
    }
    std::array<const char*, 3> result = {"Y", "Y", "Y"};
    if (color) std::copy(std::begin(channel_names), std::end(channel_names), result.begin());
    for (const char* name : result) {
        const Imf::Channel& c = channels[name];
        if (c.xSampling != 1 || c.ySampling != 1) throw file.invalid("channel " + std::string(name) + " is subsampled");
    }
    return result;
}

Image read_part(const InputFile& file, Imf::MultiPartInputFile& parts)
{
    if (parts.parts() != 1) throw file.invalid("has several parts; only single-part pictures are read");
    const Imf::Header& header = parts.header(0);
    if (header.hasType() && header.type() != Imf::SCANLINEIMAGE && header.type() != Imf::TILEDIMAGE) {
        throw file.invalid("is of type " + header.type() + "; only flat pictures are read");
    }
    const std::array<const char*, 3> names = find_channels(file, header.channels());
    const bool grey = names[0] == names[1];
    Image image;
    image.display = to_window(header.displayWindow());
    image.data = to_window(header.dataWindow());
    // Reserved memory costs nothing until it is filled, and it is filled only as far as the file truly has rows.
    const size_t width = static_cast<size_t>(image.data.width());
    image.pixels.reserve(image.data.area());
    Imf::InputPart part(parts, 0);
    constexpr int32_t rows_at_once = 256;  // no compression of the format has larger blocks
    for (int32_t y0 = image.data.y0; y0 < image.data.y1; y0 += rows_at_once) {
        const int32_t y1 = std::min(y0 + rows_at_once, image.data.y1);
        image.pixels.resize(image.pixels.size() + width * static_cast<size_t>(y1 - y0));
        Color* const rows = &image.at(image.data.x0, y0);
        const Imath::Box2i box = {{image.data.x0, y0}, {image.data.x1 - 1, y1 - 1}};
        Imf::FrameBuffer buffer;
        float* const first[] = {&rows->r, &rows->g, &rows->b};
        for (size_t c = 0; c < (grey ? 1 : 3); ++c) {
            buffer.insert(names[c], Imf::Slice::Make(Imf::FLOAT, first[c], box, sizeof(Color), sizeof(Color) * width));
        }
        part.setFrameBuffer(buffer);
        part.readPixels(y0, y1 - 1);
    }
    if (grey) {
        for (Color& c : image.pixels) c.g = c.b = c.r;
    }
    return image;
}

// Opens a picture and turns whatever the library throws into Error.
template <class F>
auto with_parts(const std::string& path, const F& f)
{
    InputFile file(path);
    check_exr_header(file);
    try {
        file.seek(0);
        FileIn stream(file);
        // The offsets of a truncated file are not reconstructed: such a picture is refused.
        Imf::MultiPartInputFile parts(stream, 0, false);
        return f(file, parts);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw Error(ErrorKind::failed, {path}, "not enough memory to read the picture");
    } catch (const std::exception& e) {
        throw file.invalid(std::string("not a valid OpenEXR file: ") + e.what());
    }
}

}  // namespace

void write_exr(AtomicFile& file, const Image& image, const Metadata& metadata, const ExrOptions& options,
               std::span<const ImagePlane> planes)
{
    if (image.data.empty() || image.display.empty() || image.pixels.size() != image.data.area()) {
        throw Error(ErrorKind::failed, {file.path()}, "cannot write a picture without pixels");
    }
    const bool as_half = options.half && fits_half(image);
    const size_t value_size = as_half ? sizeof(half) : sizeof(float);
    std::vector<half> halves(as_half ? 3 * image.pixels.size() : 0);
    for (size_t i = 0; i < halves.size() / 3; ++i) {
        const Color c = image.pixels[i];
        halves[3 * i] = half(c.r), halves[3 * i + 1] = half(c.g), halves[3 * i + 2] = half(c.b);
    }
    const char* const pixels =
        as_half ? reinterpret_cast<const char*>(halves.data()) : reinterpret_cast<const char*>(image.pixels.data());
    const size_t row_size = 3 * value_size * static_cast<size_t>(image.data.width());
    const Imf::PixelType type = as_half ? Imf::HALF : Imf::FLOAT;
    try {
        Imf::Header header(to_box(image.display), to_box(image.data));
        header.compression() = Imf::ZIP_COMPRESSION;
        Imf::addChromaticities(header, Imf::Chromaticities());  // its default is Rec. 709
        header.insert("software", Imf::StringAttribute("lancer"));
        add_metadata(header, metadata);
        Imf::FrameBuffer buffer;
        for (size_t c = 0; c < 3; ++c) {
            header.channels().insert(channel_names[c], Imf::Channel(type));
            buffer.insert(channel_names[c], Imf::Slice::Make(type, pixels + c * value_size, to_box(image.data),
                                                             3 * value_size, row_size));
        }
        for (const ImagePlane& plane : planes) {
            const char* const values = reinterpret_cast<const char*>(plane.values.data());
            header.channels().insert(plane.name, Imf::Channel(Imf::FLOAT));
            buffer.insert(plane.name, Imf::Slice::Make(Imf::FLOAT, values, to_box(image.data), sizeof(float),
                                                       sizeof(float) * static_cast<size_t>(image.data.width())));
        }
        FileOut stream(file);
        Imf::OutputFile output(stream, header, 0);
        output.setFrameBuffer(buffer);
        output.writePixels(image.data.height());
    } catch (const Error&) {
        throw;
    } catch (const std::exception& e) {
        throw Error(ErrorKind::failed, {file.path()}, std::string("cannot write: ") + e.what());
    }
}

void write_exr(const std::string& path, const Image& image, const Metadata& metadata, const ExrOptions& options,
               std::span<const ImagePlane> planes)
{
    AtomicFile file(path);
    write_exr(file, image, metadata, options, planes);
    file.commit();
}

Image read_exr(const std::string& path, Metadata* metadata)
{
    return with_parts(path, [&](const InputFile& file, Imf::MultiPartInputFile& parts) {
        Image image = read_part(file, parts);
        if (metadata) *metadata = read_metadata(parts.header(0));
        return image;
    });
}

ExrInfo read_exr_info(const std::string& path)
{
    return with_parts(path, [&](const InputFile&, Imf::MultiPartInputFile& parts) {
        const Imf::Header& header = parts.header(0);
        ExrInfo info{.display = to_window(header.displayWindow()),
                     .data = to_window(header.dataWindow()),
                     .channels = {},
                     .compression = {},
                     .metadata = read_metadata(header)};
        constexpr const char* types[] = {"uint", "half", "float"};
        constexpr const char* compressions[] = {"none",  "rle", "zips", "zip",  "piz",
                                                "pxr24", "b44", "b44a", "dwaa", "dwab"};
        for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
            const auto type = static_cast<size_t>(i.channel().type);
            info.channels.push_back({i.name(), type < std::size(types) ? types[type] : "unknown"});
        }
        const auto compression = static_cast<size_t>(header.compression());
        info.compression = compression < std::size(compressions) ? compressions[compression] : "unknown";
        return info;
    });
}

std::vector<float> read_exr_channel(const std::string& path, const std::string& name)
{
    return with_parts(path, [&](const InputFile& file, Imf::MultiPartInputFile& parts) {
        const Imf::Header& header = parts.header(0);
        const Imf::Channel* const channel = header.channels().findChannel(name);
        if (!channel || channel->xSampling != 1 || channel->ySampling != 1)
            throw file.invalid("has no channel " + name);
        const Window data = to_window(header.dataWindow());
        std::vector<float> values(data.area());
        Imf::FrameBuffer buffer;
        buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, values.data(), header.dataWindow(), sizeof(float),
                                             sizeof(float) * static_cast<size_t>(data.width())));
        Imf::InputPart part(parts, 0);
        part.setFrameBuffer(buffer);
        part.readPixels(data.y0, data.y1 - 1);
        return values;
    });
}

std::string exr_version() { return OPENEXR_VERSION_STRING; }

}  // namespace lancer
