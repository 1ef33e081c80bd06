#include "app/child.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>

#include "core/error.h"

namespace lancer {
namespace {

constexpr int look_ms = 50;  // between looks at interrupts

struct Pipe {
    std::array<int, 2> ends{-1, -1};
    Pipe()
    {
        if (pipe2(ends.data(), O_CLOEXEC) != 0)
            throw Error(ErrorKind::failed, {}, std::string("no pipe: ") + std::strerror(errno));
    }
    ~Pipe()
    {
        close_writer();
        close(ends[0]);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    void close_writer()
    {
        if (ends[1] >= 0) close(ends[1]);
        ends[1] = -1;
    }
};

}  // namespace

ChildResult run_self(const std::vector<std::string>& arguments, Signals& signals)
{
    std::vector<std::string> words{"lancer"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    Pipe pipe;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, pipe.ends[1], STDERR_FILENO);
    pid_t child = 0;
    const int problem = posix_spawn(&child, "/proc/self/exe", &actions, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (problem != 0)
        throw Error(ErrorKind::failed, {}, std::string("lancer cannot be started again: ") + std::strerror(problem));
    pipe.close_writer();

    ChildResult result;
    bool told = false;
    for (pollfd reader{pipe.ends[0], POLLIN, 0};;) {
        if (signals.interrupted() && !told) kill(child, SIGINT), told = true;
        if (poll(&reader, 1, look_ms) <= 0) continue;
        std::array<char, 4096> bytes{};
        const ssize_t n = read(pipe.ends[0], bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) break;
        result.err.append(bytes.data(), static_cast<size_t>(n));
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return result;
}

}  // namespace lancer
