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
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <OpenEXRConfig.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <new>
#include <optional>

#include "io/image/exr_channels.h"
#include "io/image/exr_header.h"
#include "io/input_file.h"

namespace lancer {
namespace {

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

// ACEScg where the chromaticities are its own, as far as programs round them.
ColorSpace space_of(const Imf::Header& header)
{
    if (!Imf::hasChromaticities(header)) return ColorSpace::lin_rec709;
    const Imf::Chromaticities& c = Imf::chromaticities(header);
    const std::array<Imath::V2f, 4> there{c.red, c.green, c.blue, c.white};
    const Chromaticities aces = chromaticities_of(ColorSpace::acescg);
    constexpr double rounding = 1e-4;
    for (size_t i = 0; i < there.size(); ++i)
        if (!(std::abs(there[i].x - aces[i][0]) < rounding && std::abs(there[i].y - aces[i][1]) < rounding))
            return ColorSpace::lin_rec709;
    return ColorSpace::acescg;
}

std::optional<ExrCamera> camera_of(const Imf::Header& header)
{
    if (!Imf::hasWorldToCamera(header) || !Imf::hasWorldToNDC(header)) return {};
    const auto rows = [](const Imath::M44f& m) {
        ExrCamera::Matrix result;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) result[static_cast<size_t>(i)][static_cast<size_t>(j)] = m[i][j];
        return result;
    };
    return ExrCamera{rows(Imf::worldToCamera(header)), rows(Imf::worldToNDC(header))};
}

bool is_flat(const Imf::Header& header)
{
    return !header.hasType() || header.type() == Imf::SCANLINEIMAGE || header.type() == Imf::TILEDIMAGE;
}

ExrChannels find_channels(const InputFile& file, const Imf::MultiPartInputFile& parts)
{
    std::vector<std::vector<std::string>> names(static_cast<size_t>(parts.parts()));
    std::string all;
    for (int part = 0; part < parts.parts(); ++part) {
        const Imf::Header& header = parts.header(part);
        for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
            if (is_flat(header)) names[static_cast<size_t>(part)].emplace_back(i.name());
            all += (all.empty() ? "" : ", ") + std::string(i.name());
        }
    }
    const std::optional<ExrChannels> chosen = choose_exr_channels(names);
    if (!chosen) throw file.invalid("needs channels R, G, B, or Y, or a layer of at most three; the file has " + all);
    return *chosen;
}

// Where to put the numbers of a channel: `place` of `stride` numbers of a pixel.
struct Placed {
    std::string name;
    size_t place;
};

std::vector<Placed> placed(const ExrChannels& chosen)
{
    std::vector<Placed> result;
    for (size_t c = 0; c < chosen.colors.size(); ++c)
        if (!chosen.colors[c].empty()) result.push_back({chosen.colors[c], c});
    if (!chosen.alpha.empty()) result.push_back({chosen.alpha, chosen.colors.size()});
    return result;
}

// rows(y0, y1) gives the place of the first number of row y0; `stride` numbers lie between pixels. Memory is asked for
// as far as the file truly has rows.
template <class Rows>
void read_channels(const InputFile& file, Imf::MultiPartInputFile& parts, int number,
                   const std::vector<Placed>& channels, size_t stride, const Rows& rows)
{
    const Imf::Header& header = parts.header(number);
    for (const Placed& channel : channels) {
        const Imf::Channel& c = header.channels()[channel.name];
        if (c.xSampling != 1 || c.ySampling != 1) throw file.invalid("channel " + channel.name + " is subsampled");
    }
    const Window data = to_window(header.dataWindow());
    const size_t pixel = stride * sizeof(float), row = pixel * static_cast<size_t>(data.width());
    Imf::InputPart part(parts, number);
    constexpr int32_t rows_at_once = 256;  // no compression of the format has larger blocks
    for (int32_t y0 = data.y0; y0 < data.y1; y0 += rows_at_once) {
        const int32_t y1 = std::min(y0 + rows_at_once, data.y1);
        float* const first = rows(y0, y1);
        const Imath::Box2i box = {{data.x0, y0}, {data.x1 - 1, y1 - 1}};
        Imf::FrameBuffer buffer;
        for (const Placed& c : channels)
            buffer.insert(c.name, Imf::Slice::Make(Imf::FLOAT, first + c.place, box, pixel, row));
        part.setFrameBuffer(buffer);
        part.readPixels(y0, y1 - 1);
    }
}

Image read_part(const InputFile& file, Imf::MultiPartInputFile& parts)
{
    ExrChannels chosen = find_channels(file, parts);
    chosen.alpha.clear();
    const auto number = static_cast<int>(chosen.part);
    const Imf::Header& header = parts.header(number);
    Image image;
    image.display = to_window(header.displayWindow());
    image.data = to_window(header.dataWindow());
    image.pixels.reserve(image.data.area());  // costs nothing until it is filled
    const auto width = static_cast<size_t>(image.data.width());
    read_channels(file, parts, number, placed(chosen), 3, [&](int32_t y0, int32_t y1) {
        image.pixels.resize(image.pixels.size() + width * static_cast<size_t>(y1 - y0));
        return &image.at(image.data.x0, y0).r;
    });
    if (chosen.colors.size() == 1) {
        for (Color& c : image.pixels) c.g = c.b = c.r;
    } else if (const ColorSpace space = space_of(header); space != ColorSpace::lin_rec709) {
        const ColorMatrix back = from_space(space);
        for (Color& c : image.pixels) c = transformed(back, c);
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

// What a raster is made of.
struct RasterPart {
    ExrChannels chosen;
    Window data, display;
    RasterHeader header;
};

RasterPart find_raster_part(const InputFile& file, const Imf::MultiPartInputFile& parts)
{
    RasterPart found{.chosen = find_channels(file, parts), .data = {}, .display = {}, .header = {}};
    const Imf::Header& header = parts.header(static_cast<int>(found.chosen.part));
    found.data = to_window(header.dataWindow()), found.display = to_window(header.displayWindow());
    // A small file may say anything of its display window.
    constexpr int64_t most = 64;
    const int64_t width = int64_t{found.display.x1} - found.display.x0,
                  height = int64_t{found.display.y1} - found.display.y0;
    if (width <= 0 || height <= 0 || width > max_image_side || height > max_image_side ||
        width * height > std::min(max_image_pixels, most * static_cast<int64_t>(found.data.area()))) {
        throw file.invalid("a display window of " + std::to_string(width) + " x " + std::to_string(height) +
                           " pixels does not suit the picture");
    }
    const std::vector<Placed> channels = placed(found.chosen);
    const bool halves = std::all_of(channels.begin(), channels.end(),
                                    [&](const Placed& c) { return header.channels()[c.name].type == Imf::HALF; });
    const size_t count = found.chosen.colors.size() + (found.chosen.alpha.empty() ? 0 : 1);
    found.header = {.width = static_cast<uint32_t>(width),
                    .height = static_cast<uint32_t>(height),
                    .channels = static_cast<uint32_t>(count),
                    .values = halves ? RasterHeader::Values::halves : RasterHeader::Values::floats,
                    .decoder_bytes = found.data != found.display ? found.data.area() * count * sizeof(float) : 0};
    return found;
}

Raster read_raster_part(const InputFile& file, Imf::MultiPartInputFile& parts)
{
    const RasterPart found = find_raster_part(file, parts);
    const Window& data = found.data;
    const size_t channels = found.header.channels, row = channels * static_cast<size_t>(data.width());
    Raster raster = {.width = found.header.width,
                     .height = found.header.height,
                     .channels = found.header.channels,
                     .bytes = {},
                     .floats = {},
                     .is_float = true};
    raster.floats.reserve(data.area() * channels);
    read_channels(file, parts, static_cast<int>(found.chosen.part), placed(found.chosen), channels,
                  [&](int32_t y0, int32_t y1) {
                      const size_t end = raster.floats.size();
                      raster.floats.resize(end + row * static_cast<size_t>(y1 - y0));
                      return &raster.floats[end];
                  });
    if (data != found.display) raster.floats = move_window(raster.floats, data, found.display, channels);
    const ColorSpace space = space_of(parts.header(static_cast<int>(found.chosen.part)));
    if (space != ColorSpace::lin_rec709 && found.chosen.colors.size() == 3) {
        const ColorMatrix back = from_space(space);
        for (size_t i = 0; i < raster.floats.size(); i += channels) {
            float* const v = &raster.floats[i];
            const Color c = transformed(back, {v[0], v[1], v[2]});
            v[0] = c.r, v[1] = c.g, v[2] = c.b;
        }
    }
    divide_by_alpha(raster);  // the format multiplies colours by alpha
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

namespace {

// A channel of any part, under the name that is its own in the whole file.
struct NamedChannel {
    std::string name;
    int part;
    const char* in_part;  // its name there
    Imf::Channel channel;
};

std::vector<NamedChannel> named_channels(const Imf::MultiPartInputFile& parts)
{
    std::vector<NamedChannel> all;
    for (int part = 0; part < parts.parts(); ++part) {
        const Imf::Header& header = parts.header(part);
        if (!is_flat(header) || header.dataWindow() != parts.header(0).dataWindow()) continue;
        for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
            const std::string name = i.name();
            const bool needs_layer = part > 0 && header.hasName() && name.find('.') == std::string::npos;
            all.push_back({needs_layer ? header.name() + "." + name : name, part, i.name(), i.channel()});
        }
    }
    return all;
}

}  // namespace

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
        for (const NamedChannel& c : named_channels(parts)) {
            const auto type = static_cast<size_t>(c.channel.type);
            info.channels.push_back({c.name, type < std::size(types) ? types[type] : "unknown"});
        }
        info.parts = parts.parts();
        info.space = space_of(header);
        info.camera = camera_of(header);
        if (header.hasTileDescription()) {
            info.tile_width = header.tileDescription().xSize;
            info.tile_height = header.tileDescription().ySize;
        }
        const auto compression = static_cast<size_t>(header.compression());
        info.compression = compression < std::size(compressions) ? compressions[compression] : "unknown";
        return info;
    });
}

std::vector<std::vector<float>> read_exr_channels(const std::string& path, std::span<const std::string> names)
{
    return with_parts(path, [&](const InputFile& file, Imf::MultiPartInputFile& parts) {
        const Imath::Box2i box = parts.header(0).dataWindow();
        const Window data = to_window(box);
        const std::vector<NamedChannel> there = named_channels(parts);
        std::vector<std::vector<float>> channels;
        std::map<int, Imf::FrameBuffer> buffers;  // of parts
        for (const std::string& name : names) {
            const auto found = std::find_if(there.begin(), there.end(), [&](const auto& c) { return c.name == name; });
            if (found == there.end() || found->channel.xSampling != 1 || found->channel.ySampling != 1)
                throw file.invalid("has no channel " + name);
            std::vector<float>& values = channels.emplace_back(data.area());
            buffers[found->part].insert(found->in_part,
                                        Imf::Slice::Make(Imf::FLOAT, values.data(), box, sizeof(float),
                                                         sizeof(float) * static_cast<size_t>(data.width())));
        }
        for (const auto& [number, buffer] : buffers) {
            Imf::InputPart part(parts, number);
            part.setFrameBuffer(buffer);
            part.readPixels(data.y0, data.y1 - 1);
        }
        return channels;
    });
}

std::vector<float> read_exr_channel(const std::string& path, const std::string& name)
{
    return std::move(read_exr_channels(path, {&name, 1})[0]);
}

Raster read_exr_raster(const std::string& path) { return with_parts(path, read_raster_part); }

RasterHeader read_exr_raster_header(const std::string& path)
{
    return with_parts(path, [](const InputFile& file, const Imf::MultiPartInputFile& parts) {
        return find_raster_part(file, parts).header;
    });
}

std::string exr_version() { return OPENEXR_VERSION_STRING; }

}  // namespace lancer
