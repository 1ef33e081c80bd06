// A viewer for tests: listens on a free port of this machine and understands what tev does, only more strictly.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "core/image.h"

namespace lancer {

// A socket bound to a free port of 127.0.0.1, not listening yet: who connects is refused.
class BoundSocket {
public:
    BoundSocket() : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0))
    {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        if (socket_ < 0 || bind(socket_, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
            getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
            throw std::runtime_error(std::string("no port for a test: ") + std::strerror(errno));
        port_ = ntohs(address.sin_port);
    }
    ~BoundSocket() { close(socket_); }
    BoundSocket(const BoundSocket&) = delete;
    BoundSocket& operator=(const BoundSocket&) = delete;

    int get() const { return socket_; }
    uint16_t port() const { return port_; }
    std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

private:
    int socket_;
    uint16_t port_ = 0;
};

// What a viewer was told.
struct Viewed {
    std::string name;
    Image image;                   // the last state
    std::vector<uint32_t> writes;  // of each pixel
    size_t creates = 0, updates = 0;
    std::string bytes;  // everything
    std::string fault;  // what was wrong with it; "" if nothing
};

// Reads packets by the letter: throws std::runtime_error at the first thing that is not as it must be.
class PacketReader {
public:
    PacketReader(const std::string& packet) : text_(packet) {}

    template <class T>
    T number()
    {
        need(sizeof(T));
        T x;
        std::memcpy(&x, text_.data() + at_, sizeof x);
        at_ += sizeof x;
        return x;
    }
    bool flag()
    {
        const auto x = number<uint8_t>();
        expect(x <= 1, "a flag is 0 or 1");
        return x == 1;
    }
    std::string word()
    {
        const size_t end = text_.find('\0', at_);
        expect(end != std::string::npos, "a text has no end");
        const std::string x = text_.substr(at_, end - at_);
        at_ = end + 1;
        return x;
    }
    void channels()
    {
        expect(number<int32_t>() == 3, "three channels");
        for (const char* name : {"R", "G", "B"}) expect(word() == name, "channels R, G, B");
    }
    void end() const { expect(at_ == text_.size(), "bytes after the end"); }
    static void expect(bool condition, const char* what)
    {
        if (!condition) throw std::runtime_error(what);
    }

private:
    void need(size_t n) const { expect(text_.size() - at_ >= n, "the packet is too short"); }

    const std::string& text_;
    size_t at_ = 0;
};

void read_packet(const std::string& packet, Viewed& viewed);

enum class Manner { reads, leaves_after_an_update, closes_at_once, never_reads };

// Serves one connection on a thread of its own.
class MockViewer {
public:
    explicit MockViewer(Manner manner = Manner::reads)
    {
        const int small = 4096;  // so that a few megabytes fill what the system keeps for those who do not read
        if (manner == Manner::never_reads) setsockopt(listener_.get(), SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
        if (listen(listener_.get(), 1) != 0) throw std::runtime_error("a test cannot listen");
        thread_ = std::thread([this, manner] { serve(manner); });
    }
    ~MockViewer() { join(); }
    MockViewer(const MockViewer&) = delete;
    MockViewer& operator=(const MockViewer&) = delete;

    uint16_t port() const { return listener_.port(); }
    std::string address() const { return listener_.address(); }
    // So far.
    size_t updates() const { return updates_; }
    // Waits until the other side has closed; then everything that it said.
    const Viewed& finish()
    {
        if (thread_.joinable()) thread_.join();
        return viewed_;
    }
    // Waits until a viewer that closes at once has done so.
    void wait_for_close() { finish(); }

private:
    void join()
    {
        shutdown(listener_.get(), SHUT_RDWR);  // if nobody came
        finish();
    }
    void serve(Manner manner)
    {
        const int connection = accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC);
        if (connection < 0) return;
        if (manner == Manner::reads) read(connection, std::numeric_limits<size_t>::max());
        if (manner == Manner::leaves_after_an_update) read(connection, 1);
        if (manner == Manner::never_reads) {
            while (accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC) >= 0) {
            }  // until the end
        }
        close(connection);
    }
    void read(int connection, size_t most_updates)
    {
        std::vector<char> buffer(1 << 16);
        size_t at = 0;
        std::string& bytes = viewed_.bytes;
        while (updates_ < most_updates) {
            const ssize_t n = recv(connection, buffer.data(), buffer.size(), 0);
            if (n <= 0) break;
            bytes.append(buffer.data(), static_cast<size_t>(n));
            try {
                for (uint32_t length = 0; bytes.size() - at >= sizeof length; at += length) {
                    std::memcpy(&length, bytes.data() + at, sizeof length);
                    PacketReader::expect(length > sizeof length, "the length");
                    if (bytes.size() - at < length) break;
                    read_packet(bytes.substr(at, length), viewed_);
                    updates_ = viewed_.updates;
                }
            } catch (const std::exception& e) {
                viewed_.fault = e.what();
                return;
            }
        }
        if (updates_ < most_updates && at != bytes.size()) viewed_.fault = "the last packet is not whole";
    }

    BoundSocket listener_;
    Viewed viewed_;  // belongs to the thread
    std::atomic<size_t> updates_{0};
    std::thread thread_;
};

}  // namespace lancer
