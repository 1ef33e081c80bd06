#include "app/run_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <thread>

namespace lancer {
namespace {

std::vector<char*> pointers(std::vector<std::string>& words)
{
    std::vector<char*> result;
    for (std::string& word : words) result.push_back(word.data());
    result.push_back(nullptr);
    return result;
}

}  // namespace

Program::Program(const TempFolder& folder, const std::vector<std::string>& arguments,
                 const std::vector<std::string>& environment)
    : out_(scratch_.file("out")), err_(scratch_.file("err"))
{
    std::vector<std::string> words{LANCER_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<std::string> variables = environment;
    for (char** e = environ; *e; ++e)
        if (!std::string(*e).starts_with("LANCER_")) variables.emplace_back(*e);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, out_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    posix_spawn_file_actions_addopen(&actions, 2, err_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    posix_spawn_file_actions_addchdir_np(&actions, folder.path().c_str());
    const int problem =
        posix_spawn(&pid_, LANCER_PROGRAM, &actions, nullptr, pointers(words).data(), pointers(variables).data());
    posix_spawn_file_actions_destroy(&actions);
    if (problem) throw Error(ErrorKind::failed, "cannot start " LANCER_PROGRAM);
}

Program::~Program()
{
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
}

bool Program::has_ended() const
{
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOWAIT | WNOHANG) != 0 || info.si_pid != 0;
}

bool Program::wait_for(const std::function<bool()>& condition) const
{
    const auto end = std::chrono::steady_clock::now() + patience;
    while (std::chrono::steady_clock::now() < end) {
        const bool is_last = has_ended();  // looked at first: what it did in the end counts
        if (condition()) return true;
        if (is_last) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

Said Program::wait()
{
    if (!wait_for([this] { return has_ended(); })) kill(pid_, SIGKILL);
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = 0;
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    return {code, read_bytes(out_), read_bytes(err_)};
}

bool Program::has_in_mask(const std::string& name, int signal) const
{
    const std::string status = read_bytes("/proc/" + std::to_string(pid_) + "/status");
    const size_t at = status.find(name);
    return at != std::string::npos && (std::stoull(status.substr(at + name.size()), nullptr, 16) >> (signal - 1) & 1);
}

Said run_program(const TempFolder& folder, const std::vector<std::string>& arguments,
                 const std::vector<std::string>& environment)
{
    return Program(folder, arguments, environment).wait();
}

const char* const AppTest::small_scene = R"(version = 1
[camera]
position = [0, 1, 5]
target = [0, 0.5, 0]
[[plane]]
point = [0, 0, 0]
normal = [0, 1, 0]
[[sphere]]
center = [0, 1, 0]
radius = 1
[[light]]
type = "sphere"
center = [2, 4, 2]
radius = 0.5
radiance = [20, 18, 15]
[[light]]
type = "environment"
radiance = [0.2, 0.3, 0.4]
)";

const char* const AppTest::quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

AppTest::AppTest()
{
    write("scene.toml", small_scene);
    write("quad.obj", quad);
}

Said AppTest::render(std::vector<std::string> arguments) const
{
    arguments.insert(arguments.begin(), {"render", "scene.toml", "--size", "24x16", "-s", "4"});
    return run(arguments);
}

std::string AppTest::metadata(const std::string& name, const std::string& key) const
{
    Metadata all;
    read_exr(file(name), &all);
    for (const auto& [k, value] : all)
        if (k == key) return to_string(value);
    return "none of this name";
}

}  // namespace lancer
