// A picture that grows in tev, the image viewer of Thomas Müller (https://github.com/Tom94/tev), by its network
// protocol: packets over TCP, in one direction. Each is its length in bytes (with these four), a byte that says what it
// does, and what that needs; integers are little-endian, texts end with a zero. Of its packets these are used:
//   CreateImage (4): grab focus (one byte), name, int32 width, height, number of channels, their names
//   UpdateImage (6, the third form, of 2021): grab focus, name, int32 number of channels, their names, int32 x, y,
//   width,
//     height, int64 for each channel where its first value stands, int64 the steps between its values, float32 values
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>

#include "core/image.h"
#include "io/net/tcp_connection.h"

namespace lancer {

class DisplayServer {
public:
    static constexpr uint16_t default_port = 14158;

    // limit: what connecting may take, and what the viewer may take for one packet.
    explicit DisplayServer(std::chrono::milliseconds limit = std::chrono::seconds(2)) : limit_(limit) {}

    // All return what went wrong, for the middle of a sentence; "" if nothing did. After a problem only connect()
    // helps.

    // See TcpConnection::connect.
    [[nodiscard]] std::string connect(const std::string& host, uint16_t port);
    // A black picture of linear R, G and B, in pixels, and brings it to the front. It takes the place of one of the
    // same name, and stays when the connection ends.
    [[nodiscard]] std::string create(const std::string& name, int32_t width, int32_t height);
    // Pixels of that picture: rows of the window, top first; a window at a time of at most 2^26 pixels.
    [[nodiscard]] std::string update(const Window& where, std::span<const Color> pixels);

private:
    TcpConnection connection_;
    std::chrono::milliseconds limit_;
    std::string name_;
};

}  // namespace lancer
