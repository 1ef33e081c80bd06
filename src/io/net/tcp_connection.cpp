#include "io/net/tcp_connection.h"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <future>
#include <thread>
#include <vector>

namespace lancer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* too_late = "no answer in time";

struct Address {
    sockaddr_storage bytes{};
    socklen_t size = 0;
};

struct Resolved {
    std::vector<Address> addresses;  // in the order in which they should be tried
    std::string problem;
};

Resolved resolve(const std::string& host, uint16_t port)
{
    addrinfo hints{};
    hints.ai_family = AF_UNSPEC;
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* list = nullptr;
    const int fault = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &list);
    if (fault != 0) return {{}, fault == EAI_SYSTEM ? std::strerror(errno) : gai_strerror(fault)};
    Resolved result;
    for (const addrinfo* a = list; a; a = a->ai_next) {
        Address& address = result.addresses.emplace_back();
        address.size = a->ai_addrlen;
        std::memcpy(&address.bytes, a->ai_addr, a->ai_addrlen);
    }
    freeaddrinfo(list);
    return result;
}

// The system's look-up has no time limit, so it runs on a thread that is left to itself when time is up.
Resolved resolve(const std::string& host, uint16_t port, Clock::time_point deadline)
{
    std::packaged_task<Resolved()> task([=] { return resolve(host, port); });
    std::future<Resolved> answer = task.get_future();
    std::thread(std::move(task)).detach();
    if (answer.wait_until(deadline) != std::future_status::ready) return {{}, "the name is not found in time"};
    return answer.get();
}

// The events that came before the deadline; 0 if none did.
short wait_for(int socket, short events, Clock::time_point deadline)
{
    for (;;) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
        pollfd p{socket, events, 0};
        const int n = poll(&p, 1, static_cast<int>(std::max<decltype(left)>(left, 0)));
        if (n > 0) return p.revents;
        if (n == 0 || errno != EINTR) return 0;
    }
}

// Of a connection that is being made: 0 once it stands, else an errno.
int outcome(int socket, Clock::time_point deadline)
{
    if (wait_for(socket, POLLOUT, deadline) == 0) return ETIMEDOUT;
    int problem = 0;
    socklen_t size = sizeof problem;
    return getsockopt(socket, SOL_SOCKET, SO_ERROR, &problem, &size) == 0 ? problem : errno;
}

}  // namespace

TcpConnection::~TcpConnection() { close(); }

void TcpConnection::close()
{
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
}

std::string TcpConnection::connect(const std::string& host, uint16_t port, std::chrono::milliseconds limit)
{
    close();
    const Clock::time_point deadline = Clock::now() + limit;
    const Resolved resolved = resolve(host, port, deadline);
    std::string problem = resolved.problem;
    auto left = static_cast<Clock::rep>(resolved.addresses.size());
    for (const Address& address : resolved.addresses) {
        const Clock::time_point now = Clock::now();
        const Clock::time_point its_deadline = now + (deadline - now) / left--;  // a dead one leaves time to others
        socket_ = socket(address.bytes.ss_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
        int fault = 0;
        if (socket_ < 0 || ::connect(socket_, reinterpret_cast<const sockaddr*>(&address.bytes), address.size) != 0)
            fault = errno;
        if (fault == EINPROGRESS || fault == EINTR) fault = outcome(socket_, its_deadline);
        if (fault == 0) return "";
        problem = fault == ETIMEDOUT ? too_late : std::strerror(fault);
        close();
    }
    return problem;
}

std::string TcpConnection::send(const void* bytes, size_t count, std::chrono::milliseconds limit)
{
    const auto fail = [this](const char* problem) {
        close();
        return std::string(problem);
    };
    if (socket_ < 0) return fail("it is not connected");
    const Clock::time_point deadline = Clock::now() + limit;
    for (const char* next = static_cast<const char*>(bytes); count > 0;) {
        const short events = wait_for(socket_, POLLOUT | POLLRDHUP, deadline);
        if (events == 0) return fail("it does not read");
        // Bytes for someone who has left would be taken all the same, once.
        if (events & (POLLRDHUP | POLLHUP)) return fail("it closed the connection");
        const ssize_t sent = ::send(socket_, next, count, MSG_NOSIGNAL);
        if (sent < 0 && (errno == EAGAIN || errno == EINTR)) continue;
        if (sent < 0)
            return fail(errno == EPIPE || errno == ECONNRESET ? "it closed the connection" : std::strerror(errno));
        next += sent;
        count -= static_cast<size_t>(sent);
    }
    return "";
}

}  // namespace lancer
