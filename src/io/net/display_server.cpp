#include "io/net/display_server.h"

#include <array>
#include <bit>
#include <cstring>
#include <string_view>
#include <vector>

namespace lancer {
namespace {

static_assert(std::endian::native == std::endian::little, "packets are little-endian");
static_assert(sizeof(Color) == 3 * sizeof(float), "pixels go out as they stand in memory");

constexpr std::array<std::string_view, 3> channel_names{"R", "G", "B"};

enum class Operation : uint8_t { create_image = 4, update_image = 6 };

class Packet {
public:
    explicit Packet(Operation operation)
    {
        put(uint32_t{0});  // the length, not known yet
        put(operation);
    }

    template <class T>
    void put(T value)
    {
        append(&value, sizeof value);
    }
    void put_text(std::string_view text)
    {
        append(text.data(), text.size());
        put('\0');
    }
    void put_channels()
    {
        put(static_cast<int32_t>(channel_names.size()));
        for (const std::string_view channel : channel_names) put_text(channel);
    }
    void append(const void* data, size_t count)
    {
        const size_t at = bytes_.size();
        bytes_.resize(at + count);
        if (count > 0) std::memcpy(bytes_.data() + at, data, count);
    }

    std::string send(TcpConnection& connection, std::chrono::milliseconds limit)
    {
        const auto length = static_cast<uint32_t>(bytes_.size());
        std::memcpy(bytes_.data(), &length, sizeof length);
        return connection.send(bytes_.data(), bytes_.size(), limit);
    }

private:
    std::vector<char> bytes_;
};

}  // namespace

std::string DisplayServer::connect(const std::string& host, uint16_t port)
{
    return connection_.connect(host, port, limit_);
}

std::string DisplayServer::create(const std::string& name, int32_t width, int32_t height)
{
    name_ = name;
    Packet packet(Operation::create_image);
    packet.put(true);
    packet.put_text(name_);
    packet.put(width);
    packet.put(height);
    packet.put_channels();
    return packet.send(connection_, limit_);
}

std::string DisplayServer::update(const Window& where, std::span<const Color> pixels)
{
    Packet packet(Operation::update_image);
    packet.put(false);  // whoever looks at another picture shall not be called away
    packet.put_text(name_);
    packet.put_channels();
    for (const int32_t x : {where.x0, where.y0, where.width(), where.height()}) packet.put(x);
    for (size_t c = 0; c < channel_names.size(); ++c) packet.put(static_cast<int64_t>(c));
    for (size_t c = 0; c < channel_names.size(); ++c) packet.put(static_cast<int64_t>(channel_names.size()));
    packet.append(pixels.data(), pixels.size_bytes());
    return packet.send(connection_, limit_);
}

}  // namespace lancer
