// A TCP connection that never blocks beyond its time limits, throws on failure of the peer or raises SIGPIPE. It only
// sends; it notices when the other side closes.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

namespace lancer {

class TcpConnection {
public:
    TcpConnection() = default;
    ~TcpConnection();  // closes; what was sent still arrives
    TcpConnection(const TcpConnection&) = delete;
    TcpConnection& operator=(const TcpConnection&) = delete;

    // Both return what went wrong, for the middle of a sentence; "" if nothing did. Once something did, every send
    // fails. Throws std::system_error if there is no thread to be had for looking up a name.

    // host: a name or a numeric address (IPv4, IPv6). The limit is for everything together.
    [[nodiscard]] std::string connect(const std::string& host, uint16_t port, std::chrono::milliseconds limit);
    // All the bytes, in order, or a problem: also if the other side has not taken them within the limit.
    [[nodiscard]] std::string send(const void* bytes, size_t count, std::chrono::milliseconds limit);

private:
    void close();

    int socket_ = -1;  // -1: none
};

}  // namespace lancer
