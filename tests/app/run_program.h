// Runs the real program in a folder of its own and tells what it said.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "io/image/exr.h"
#include "io/temp_folder.h"

namespace lancer {

struct Said {
    int code = -1;  // exit code; 1000 + signal if one ended it
    std::string out, err;
};

// A running program. Its output goes through files, so that it never waits for a reader.
class Program {
public:
    Program(const TempFolder& folder, const std::vector<std::string>& arguments,
            const std::vector<std::string>& environment = {})
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
    ~Program()
    {
        if (pid_ <= 0) return;
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
    }
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    pid_t pid() const { return pid_; }
    void send(int signal) const { kill(pid_, signal); }
    std::string err() const { return read_bytes(err_); }
    bool has_ended() const
    {
        siginfo_t info{};
        return waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOWAIT | WNOHANG) != 0 || info.si_pid != 0;
    }
    // False if that did not happen before the program ended, or in `patience`: so long that no other work on the
    // machine uses it up.
    bool wait_for(const std::function<bool()>& condition) const
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
    bool wait_for_message(const std::string& words) const
    {
        return wait_for([&] { return err().find(words) != std::string::npos; });
    }
    // Whether it handles a signal by itself, or has one that it was not given yet.
    bool catches(int signal) const { return has_in_mask("SigCgt:", signal); }
    bool has_pending(int signal) const { return has_in_mask("ShdPnd:", signal); }
    // Kills it if it does not end in `patience`.
    Said wait()
    {
        if (!wait_for([this] { return has_ended(); })) kill(pid_, SIGKILL);
        int status = 0;
        waitpid(pid_, &status, 0);
        pid_ = 0;
        const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
        return {code, read_bytes(out_), read_bytes(err_)};
    }

private:
    static constexpr auto patience = std::chrono::minutes(8);

    // As /proc/PID/status has it: hexadecimal, the lowest bit for signal 1.
    bool has_in_mask(const std::string& name, int signal) const
    {
        const std::string status = read_bytes("/proc/" + std::to_string(pid_) + "/status");
        const size_t at = status.find(name);
        return at != std::string::npos &&
               (std::stoull(status.substr(at + name.size()), nullptr, 16) >> (signal - 1) & 1);
    }
    static std::vector<char*> pointers(std::vector<std::string>& words)
    {
        std::vector<char*> result;
        for (std::string& word : words) result.push_back(word.data());
        result.push_back(nullptr);
        return result;
    }

    TempFolder scratch_;
    std::string out_, err_;
    pid_t pid_ = 0;
};

// A limit of the system on this process and what it starts, for as long as the object lives.
class Limited {
public:
    Limited(__rlimit_resource what, rlim_t most) : what_(what)
    {
        getrlimit(what, &before_);
        const rlimit now{most, before_.rlim_max};
        setrlimit(what, &now);
    }
    ~Limited() { setrlimit(what_, &before_); }
    Limited(const Limited&) = delete;
    Limited& operator=(const Limited&) = delete;

private:
    __rlimit_resource what_;
    rlimit before_{};
};

inline Said run_program(const TempFolder& folder, const std::vector<std::string>& arguments,
                        const std::vector<std::string>& environment = {})
{
    return Program(folder, arguments, environment).wait();
}

// A folder with a small scene, scene.toml, and a mesh, quad.obj.
class AppTest : public testing::Test {
protected:
    AppTest()
    {
        write("scene.toml", small_scene);
        write("quad.obj", quad);
    }
    void write(const std::string& name, const std::string& text) const { write_bytes(folder_.file(name), text); }
    std::string file(const std::string& name) const { return folder_.file(name); }
    bool exists(const std::string& name) const { return std::filesystem::exists(file(name)); }

    Said run(const std::vector<std::string>& arguments, const std::vector<std::string>& environment = {}) const
    {
        return run_program(folder_, arguments, environment);
    }
    // Renders scene.toml at 24x16 with 4 samples unless the arguments say something else.
    Said render(std::vector<std::string> arguments) const
    {
        arguments.insert(arguments.begin(), {"render", "scene.toml", "--size", "24x16", "-s", "4"});
        return run(arguments);
    }
    Image image(const std::string& name) const { return read_exr(file(name)); }
    std::string metadata(const std::string& name, const std::string& key) const
    {
        Metadata all;
        read_exr(file(name), &all);
        for (const auto& [k, value] : all)
            if (k == key) return to_string(value);
        return "none of this name";
    }

    static constexpr const char* small_scene = R"(version = 1
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
    static constexpr const char* quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

    TempFolder folder_;
};

inline bool same_pixels(const Image& a, const Image& b)
{
    return a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(Color)) == 0;
}

// That the text contains the words, with both in the message if not.
inline void expect_words(const std::string& text, const std::string& words)
{
    EXPECT_NE(text.find(words), std::string::npos) << "looked for: " << words << "\nin: " << text;
}

}  // namespace lancer
