#include "io/image/exr.h"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <OpenEXRConfig.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>

#include "io/image/exr_header.h"
#include "io/input_file.h"

namespace lancer {
namespace {

constexpr const char* channel_names[] = {"R", "G", "B"};

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

Window to_window(const Imath::Box2i& b) { return {b.min.x, b.min.y, b.max.x + 1, b.max.y + 1}; }

Metadata read_metadata(const Imf::Header& header)
{
    Metadata result;
    for (auto i = header.begin(); i != header.end(); ++i) {
        if (std::strncmp(i.name(), exr_prefix, std::strlen(exr_prefix)) != 0) continue;
        const std::string name = i.name() + std::strlen(exr_prefix);
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

using Names = std::vector<const char*>;

// The channels to read: R, G, B, or Y alone. Others in the file are left alone.
Names find_channels(const InputFile& file, const Imf::ChannelList& channels)
{
    const bool color = channels.findChannel("R") && channels.findChannel("G") && channels.findChannel("B");
    if (!color && (!channels.findChannel("Y") || channels.findChannel("RY") || channels.findChannel("BY"))) {
        std::string names;
        for (auto i = channels.begin(); i != channels.end(); ++i)
            names += (names.empty() ? "" : ", ") + std::string(i.name());
        throw file.invalid("needs channels R, G, B, or Y alone; the file has " + names);
    }
    return color ? Names(std::begin(channel_names), std::end(channel_names)) : Names{"Y"};
}

const Imf::Header& check_part(const InputFile& file, const Imf::MultiPartInputFile& parts)
{
    if (parts.parts() != 1) throw file.invalid("has several parts; only single-part pictures are read");
    const Imf::Header& header = parts.header(0);
    if (header.hasType() && header.type() != Imf::SCANLINEIMAGE && header.type() != Imf::TILEDIMAGE) {
        throw file.invalid("is of type " + header.type() + "; only flat pictures are read");
    }
    return header;
}

// rows(y0, y1) gives the place of the first number of row y0; `stride` numbers lie between pixels. Memory is asked for
// as far as the file truly has rows.
template <class Rows>
void read_channels(const InputFile& file, Imf::MultiPartInputFile& parts, const Names& names, size_t stride,
                   const Rows& rows)
{
    const Imf::Header& header = parts.header(0);
    for (const char* name : names) {
        const Imf::Channel& c = header.channels()[name];
        if (c.xSampling != 1 || c.ySampling != 1) throw file.invalid("channel " + std::string(name) + " is subsampled");
    }
    const Window data = to_window(header.dataWindow());
    const size_t pixel = stride * sizeof(float), row = pixel * static_cast<size_t>(data.width());
    Imf::InputPart part(parts, 0);
    constexpr int32_t rows_at_once = 256;  // no compression of the format has larger blocks
    for (int32_t y0 = data.y0; y0 < data.y1; y0 += rows_at_once) {
        const int32_t y1 = std::min(y0 + rows_at_once, data.y1);
        float* const first = rows(y0, y1);
        const Imath::Box2i box = {{data.x0, y0}, {data.x1 - 1, y1 - 1}};
        Imf::FrameBuffer buffer;
        for (size_t c = 0; c < names.size(); ++c)
            buffer.insert(names[c], Imf::Slice::Make(Imf::FLOAT, first + c, box, pixel, row));
        part.setFrameBuffer(buffer);
        part.readPixels(y0, y1 - 1);
    }
}

Image read_part(const InputFile& file, Imf::MultiPartInputFile& parts)
{
    const Imf::Header& header = check_part(file, parts);
    const Names names = find_channels(file, header.channels());
    Image image;
    image.display = to_window(header.displayWindow());
    image.data = to_window(header.dataWindow());
    image.pixels.reserve(image.data.area());  // costs nothing until it is filled
    const auto width = static_cast<size_t>(image.data.width());
    read_channels(file, parts, names, 3, [&](int32_t y0, int32_t y1) {
        image.pixels.resize(image.pixels.size() + width * static_cast<size_t>(y1 - y0));
        return &image.at(image.data.x0, y0).r;
    });
    if (names.size() == 1) {
        for (Color& c : image.pixels) c.g = c.b = c.r;
    }
    return image;
}

// What of a picture of `from` lies in `to`, nothing elsewhere.
std::vector<float> move_window(const std::vector<float>& values, const Window& from, const Window& to, size_t channels)
{
    std::vector<float> result(to.area() * channels);
    const int32_t x0 = std::max(from.x0, to.x0), x1 = std::min(from.x1, to.x1);
    for (int32_t y = std::max(from.y0, to.y0); y < std::min(from.y1, to.y1) && x0 < x1; ++y) {
        const auto place = [&](const Window& w) {
            return (static_cast<size_t>(y - w.y0) * static_cast<size_t>(w.width()) + static_cast<size_t>(x0 - w.x0)) *
                   channels;
        };
        std::copy_n(&values[place(from)], static_cast<size_t>(x1 - x0) * channels, &result[place(to)]);
    }
    return result;
}

Raster read_raster_part(const InputFile& file, Imf::MultiPartInputFile& parts)
{
    const Imf::Header& header = check_part(file, parts);
    Names names = find_channels(file, header.channels());
    if (header.channels().findChannel("A")) names.push_back("A");
    const Window data = to_window(header.dataWindow()), display = to_window(header.displayWindow());
    // A small file may say anything of its display window.
    constexpr int64_t most = 64;
    const int64_t width = int64_t{display.x1} - display.x0, height = int64_t{display.y1} - display.y0;
    if (width <= 0 || height <= 0 || width > max_image_side || height > max_image_side ||
        width * height > std::min(max_image_pixels, most * static_cast<int64_t>(data.area()))) {
        throw file.invalid("a display window of " + std::to_string(width) + " x " + std::to_string(height) +
                           " pixels does not suit the picture");
    }
    const size_t channels = names.size(), row = channels * static_cast<size_t>(data.width());
    Raster raster = {.width = static_cast<uint32_t>(width),
                     .height = static_cast<uint32_t>(height),
                     .channels = static_cast<uint32_t>(channels),
                     .bytes = {},
                     .floats = {},
                     .is_float = true};
    raster.floats.reserve(data.area() * channels);
    read_channels(file, parts, names, channels, [&](int32_t y0, int32_t y1) {
        const size_t end = raster.floats.size();
        raster.floats.resize(end + row * static_cast<size_t>(y1 - y0));
        return &raster.floats[end];
    });
    if (data != display) raster.floats = move_window(raster.floats, data, display, channels);
    return raster;
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

Raster read_exr_raster(const std::string& path) { return with_parts(path, read_raster_part); }

std::string exr_version() { return OPENEXR_VERSION_STRING; }

}  // namespace lancer
