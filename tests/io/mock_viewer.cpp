#include "io/mock_viewer.h"

namespace lancer {

void read_packet(const std::string& packet, Viewed& viewed)
{
    PacketReader p(packet);
    p.expect(p.number<uint32_t>() == packet.size(), "the length");
    const auto operation = p.number<uint8_t>();
    if (operation == 4) {
        p.expect(p.flag(), "a new picture is shown");
        viewed.name = p.word();
        const auto width = p.number<int32_t>(), height = p.number<int32_t>();
        p.expect(width > 0 && height > 0, "the size");
        p.channels();
        viewed.image = make_image(width, height);
        viewed.writes.assign(viewed.image.pixels.size(), 0);
        ++viewed.creates;
    } else {
        p.expect(operation == 6, "CreateImage or UpdateImage");
        p.expect(!p.flag(), "an update does not call for attention");
        p.expect(viewed.creates == 1 && p.word() == viewed.name, "the picture exists");
        p.channels();
        const auto x = p.number<int32_t>(), y = p.number<int32_t>();
        const auto width = p.number<int32_t>(), height = p.number<int32_t>();
        const Window& all = viewed.image.display;
        p.expect(x >= 0 && y >= 0 && width > 0 && height > 0 && x + width <= all.x1 && y + height <= all.y1,
                 "the window");
        for (const int64_t offset : {0, 1, 2}) p.expect(p.number<int64_t>() == offset, "the offsets");
        for (int i = 0; i < 3; ++i) p.expect(p.number<int64_t>() == 3, "the strides");
        for (int32_t j = y; j < y + height; ++j)
            for (int32_t i = x; i < x + width; ++i) {
                viewed.image.at(i, j) = p.number<Color>();
                ++viewed.writes[static_cast<size_t>(j) * static_cast<size_t>(all.width()) + static_cast<size_t>(i)];
            }
        ++viewed.updates;
    }
    p.end();
}

}  // namespace lancer
