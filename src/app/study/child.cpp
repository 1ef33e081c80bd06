#include "app/study/child.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <optional>

#include "app/system_info.h"
#include "core/error.h"

namespace lancer {
namespace {

constexpr int look_ms = 50;     // between looks at interrupts and clocks
constexpr int end_ms = 2;       // between looks whether a child has ended that has nothing more to say
constexpr double grace_s = 30;  // from an interrupt to the end
constexpr size_t read_size = 4096, most_in_pipe = size_t{1} << 20;  // bytes; Linux lets users have no larger pipe

struct Pipe {
    std::array<int, 2> ends{-1, -1};
    Pipe()
    {
        if (pipe2(ends.data(), O_CLOEXEC) != 0)
            throw Error(ErrorKind::failed, {}, std::string("no pipe: ") + std::strerror(errno));
    }
    ~Pipe()
    {
        for (int& end : ends) close_end(end);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    static void close_end(int& end)
    {
        if (end >= 0) close(end);
        end = -1;
    }
};

std::vector<char*> pointers_to(std::vector<std::string>& words)
{
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

std::vector<std::string> environment_of(const ChildOrder& order)
{
    std::vector<std::string> variables;
    for (const auto& [name, value] : order.environment) variables.push_back(name + "=" + value);
    const size_t own = variables.size();
    for (char** e = environ; *e; ++e) {
        const std::string_view variable(*e);
        const bool replaced =
            std::any_of(variables.begin(), variables.begin() + static_cast<std::ptrdiff_t>(own),
                        [&](const std::string& v) { return variable.starts_with(v.substr(0, v.find('=') + 1)); });
        if (!replaced) variables.emplace_back(variable);
    }
    return variables;
}

pid_t spawn(const ChildOrder& order, const Pipe& out, const Pipe& err)
{
    std::vector<std::string> words{order.name.empty() ? order.program : order.name}, variables = environment_of(order);
    words.insert(words.end(), order.arguments.begin(), order.arguments.end());
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, out.ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err.ends[1], STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    pid_t child = 0;
    const int problem = posix_spawn(&child, order.program.c_str(), &actions, &attributes, pointers_to(words).data(),
                                    pointers_to(variables).data());
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (problem != 0)
        throw Error(ErrorKind::failed, {order.program}, std::string("cannot be started: ") + std::strerror(problem));
    return child;
}

// At the end of what there is to read, the end of the pipe is closed. Whether anything was there.
bool read_some(int& end, std::string& text)
{
    std::array<char, read_size> bytes{};
    const ssize_t n = read(end, bytes.data(), bytes.size());
    if (n > 0) text.append(bytes.data(), static_cast<size_t>(n));
    if (n == 0 || (n < 0 && errno != EINTR)) Pipe::close_end(end);
    return n > 0;
}

// Of a child: its end, once that has come.
std::optional<int> end_of(pid_t child)
{
    int status = 0;
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended < 0 && errno != EINTR)
        throw Error(ErrorKind::failed, {}, std::string("how a child ended is not known: ") + std::strerror(errno));
    if (ended != child) return {};
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

ChildResult run_child(const ChildOrder& order, Signals& signals)
{
    std::signal(SIGCHLD, SIG_DFL);  // whoever started us may have set it to be ignored: no child's end would be told
    Pipe out, err;
    const double start = wall_seconds();
    const pid_t child = spawn(order, out, err);
    Pipe::close_end(out.ends[1]), Pipe::close_end(err.ends[1]);
    ChildResult result;
    // Reads what there is, after waiting for it so long. Whether anything was there.
    const auto read_for = [&](int milliseconds) {
        // A closed end is negative, and passed over.
        std::array<pollfd, 2> readers{{{out.ends[0], POLLIN, 0}, {err.ends[0], POLLIN, 0}}};
        if (poll(readers.data(), readers.size(), milliseconds) <= 0) return false;
        const bool some_out = readers[0].revents && read_some(out.ends[0], result.out);
        const bool some_err = readers[1].revents && read_some(err.ends[0], result.err);
        return some_out || some_err;
    };
    double killed_at = std::numeric_limits<double>::infinity();
    bool told = false;
    std::optional<int> code;
    // Until the child has ended, not until its pipes have: it may close them and go on, and what it started may keep
    // them open.
    while (!(code = end_of(child))) {
        if (signals.interrupted() && !told) {
            kill(-child, SIGINT);
            told = true, killed_at = wall_seconds() + grace_s;
        }
        if (wall_seconds() - start > order.timeout_s) result.timed_out = true, killed_at = 0;
        if (wall_seconds() > killed_at) kill(-child, SIGKILL);
        const bool closed = out.ends[0] < 0 && err.ends[0] < 0;
        read_for(closed ? end_ms : look_ms);
    }
    result.code = *code;
    for (size_t i = 0; i < most_in_pipe / read_size && read_for(0); ++i) {
    }
    return result;
}

std::string own_program() { return "/proc/" + std::to_string(getpid()) + "/exe"; }

ChildResult run_self(const std::vector<std::string>& arguments, Signals& signals)
{
    return run_child({.program = "/proc/self/exe", .name = "lancer", .arguments = arguments, .environment = {}},
                     signals);
}

}  // namespace lancer
