#include "io/image/exr_header.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

namespace lancer {
namespace {

static_assert(std::endian::native == std::endian::little, "the format's byte order is read as it stands");

constexpr uint32_t magic = 20000630;
constexpr uint32_t flag_tiled = 0x200, flag_deep = 0x800, flag_multipart = 0x1000;

constexpr int64_t max_block_bytes = int64_t{1} << 30;  // one compressed block, all channels, uncompressed

// What of the header decides how much the library allocates.
struct Extent {
    bool has_window = false, has_channels = false, is_tiled = false;
    int64_t width = 0, height = 0;
    int64_t tile_width = 0, tile_height = 0;  // 0: scan lines
    int64_t pixel_bytes = 0;
    int64_t block_rows = 1;
    int64_t chunks = 0;  // of a file of several parts: what it says of their number
};

class HeaderReader {
public:
    explicit HeaderReader(InputFile& file) : file_(file) {}

    template <class T>
    T value()
    {
        T v;
        if (file_.read(&v, sizeof v) != sizeof v)
            throw file_.invalid("not a valid OpenEXR file: the header ends early");
        return v;
    }
    std::string name()
    {
        std::string s;
        for (char c = value<char>(); c != 0; c = value<char>()) {
            if (s.size() == 255) throw file_.invalid("not a valid OpenEXR file: a name in the header is too long");
            s += c;
        }
        return s;
    }
    InputFile& file() { return file_; }

private:
    InputFile& file_;
};

void read_window(HeaderReader& in, Extent& extent)
{
    const auto box = in.value<std::array<int32_t, 4>>();
    extent.width = int64_t{box[2]} - box[0] + 1;
    extent.height = int64_t{box[3]} - box[1] + 1;
    extent.has_window = true;
}

// Bytes of a value of the types that have always as many. The library reads so many, whatever the size field says, and
// would take what comes next for an attribute.
constexpr std::pair<std::string_view, int32_t> sizes_of_types[] = {{"box2f", 16},
                                                                   {"box2i", 16},
                                                                   {"chromaticities", 32},
                                                                   {"compression", 1},
                                                                   {"deepImageState", 1},
                                                                   {"double", 8},
                                                                   {"envmap", 1},
                                                                   {"float", 4},
                                                                   {"int", 4},
                                                                   {"keycode", 28},
                                                                   {"lineOrder", 1},
                                                                   {"m33d", 72},
                                                                   {"m33f", 36},
                                                                   {"m44d", 128},
                                                                   {"m44f", 64},
                                                                   {"rational", 8},
                                                                   {"tiledesc", 9},
                                                                   {"timecode", 8},
                                                                   {"v2d", 16},
                                                                   {"v2f", 8},
                                                                   {"v2i", 8},
                                                                   {"v3d", 24},
                                                                   {"v3f", 12},
                                                                   {"v3i", 12}};

bool fits_type(const std::string& type, int32_t size)
{
    if (type == "floatvector") return size % 4 == 0;
    for (const auto& [name, bytes] : sizes_of_types)
        if (type == name) return size == bytes;
    return true;
}

void read_channels(HeaderReader& in, Extent& extent)
{
    extent.pixel_bytes = 0;
    for (std::string name = in.name(); !name.empty(); name = in.name()) {
        const auto fields = in.value<std::array<int32_t, 4>>();  // type, linear, sampling in x and in y
        extent.pixel_bytes += fields[0] == 1 ? 2 : 4;
    }
    extent.has_channels = true;
}

int64_t rows_of_block(uint8_t compression)
{
    constexpr uint8_t rows[] = {1, 1, 1, 16, 32, 16, 32, 32, 32};
    return compression < std::size(rows) ? rows[compression] : 256;  // the last one, DWAB, and what may follow it
}

void read_attribute(HeaderReader& in, const std::string& name, const std::string& type, int32_t size, Extent& extent)
{
    if (name == "dataWindow" && size == 16) read_window(in, extent);
    Extent of_no_picture;
    if (type == "chlist") read_channels(in, name == "channels" ? extent : of_no_picture);
    if (name == "compression" && size == 1) extent.block_rows = rows_of_block(in.value<uint8_t>());
    if (name == "chunkCount" && size == 4) extent.chunks = in.value<int32_t>();
    if (name == "tiles" && size == 9) {
        const auto sides = in.value<std::array<uint32_t, 2>>();
        extent.tile_width = sides[0];
        extent.tile_height = sides[1];
        if (sides[0] == 0 || sides[1] == 0) throw in.file().invalid("not a valid OpenEXR file: tiles of size 0");
    }
}

void check_extent(const InputFile& file, const Extent& e)
{
    const bool tiled = e.is_tiled;
    if (!e.has_window || !e.has_channels || (tiled && e.tile_width == 0)) {
        throw file.invalid("not a valid OpenEXR file: the header lacks a required attribute");
    }
    const std::string size = std::to_string(e.width) + " x " + std::to_string(e.height);
    if (e.width <= 0 || e.height <= 0) throw file.invalid("not a valid OpenEXR file: the picture is " + size);
    if (e.width > max_image_side || e.height > max_image_side || e.width * e.height > max_image_pixels) {
        throw file.invalid("picture too large: " + size + " pixels");
    }
    const int64_t block_width = tiled ? e.tile_width : e.width;
    const int64_t block_rows = tiled ? e.tile_height : e.block_rows;
    if (block_width > max_image_side || block_rows > max_image_side ||
        block_width * block_rows > max_block_bytes / std::max(e.pixel_bytes, int64_t{1})) {
        throw file.invalid("blocks of " + std::to_string(block_width) + " x " + std::to_string(block_rows) +
                           " pixels of " + std::to_string(e.pixel_bytes) + " bytes are too large");
    }
    // Each block has at least its place in the table of offsets, its coordinates and its size.
    const int64_t across = (e.width + block_width - 1) / block_width;
    const int64_t down = (e.height + block_rows - 1) / block_rows;
    if (e.chunks < 0 || static_cast<uint64_t>(std::max(across * down, e.chunks)) * 16 > file.size()) {
        throw file.invalid("the file is too short for a picture of " + size + " pixels");
    }
}

// One header, up to the empty name at its end. has_type: the attribute "type" decides whether there are tiles.
void check_part(HeaderReader& in, const std::string& first_name, bool has_type, bool is_tiled)
{
    InputFile& file = in.file();
    Extent extent;
    extent.is_tiled = is_tiled;
    for (std::string name = first_name; !name.empty(); name = in.name()) {
        const std::string attribute_type = in.name();
        const int32_t size = in.value<int32_t>();
        const uint64_t start = file.tell();
        if (size < 0 || static_cast<uint64_t>(size) > file.size() - std::min(start, file.size())) {
            throw file.invalid("not a valid OpenEXR file: attribute " + name + " is longer than the file");
        }
        if (has_type && name == "type") {
            std::string type;
            while (type.size() < static_cast<size_t>(std::min(size, 16))) type += in.value<char>();
            extent.is_tiled = type.starts_with("tiled") || type.starts_with("deeptile");
        }
        read_attribute(in, name, attribute_type, size, extent);
        const uint64_t end = start + static_cast<uint64_t>(size);
        if (!fits_type(attribute_type, size) || (attribute_type == "chlist" && file.tell() != end))
            throw file.invalid("not a valid OpenEXR file: attribute " + name + " is not as long as its type");
        file.seek(end);
    }
    check_extent(file, extent);
}

}  // namespace

void check_exr_header(InputFile& file)
{
    HeaderReader in(file);
    file.seek(0);
    if (in.value<uint32_t>() != magic) throw file.invalid("not an OpenEXR file");
    const uint32_t version = in.value<uint32_t>();
    const bool several = (version & flag_multipart) != 0;
    if (!several && (version & flag_deep)) throw file.invalid("deep OpenEXR files are not read");
    std::string name = in.name();
    do {
        check_part(in, name, several, (version & flag_tiled) != 0);
        if (several) name = in.name();  // an empty one ends the headers
    } while (several && !name.empty());
}

}  // namespace lancer
