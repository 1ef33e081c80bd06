// Runs the real program in a folder of its own and tells what it said.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "io/image/exr.h"
#include "io/temp_folder.h"

namespace lancer {

using Arguments = std::vector<std::string>;

inline Arguments operator+(Arguments a, const Arguments& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

struct Said {
    int code = -1;  // exit code; 1000 + signal if one ended it
    std::string out, err;
};

// A running program. Its output goes through files, so that it never waits for a reader.
class Program {
public:
    Program(const TempFolder& folder, const std::vector<std::string>& arguments,
            const std::vector<std::string>& environment = {});
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    pid_t pid() const { return pid_; }
    void send(int signal) const { kill(pid_, signal); }
    std::string err() const { return read_bytes(err_); }
    bool has_ended() const;
    // False if that did not happen before the program ended, or in `patience`: so long that no other work on the
    // machine uses it up.
    bool wait_for(const std::function<bool()>& condition) const;
    bool wait_for_message(const std::string& words) const
    {
        return wait_for([&] { return err().find(words) != std::string::npos; });
    }
    // Whether it handles a signal by itself, or has one that it was not given yet.
    bool catches(int signal) const { return has_in_mask("SigCgt:", signal); }
    bool has_pending(int signal) const { return has_in_mask("ShdPnd:", signal); }
    // Kills it if it does not end in `patience`.
    Said wait();

private:
    static constexpr auto patience = std::chrono::minutes(8);

    // As /proc/PID/status has it: hexadecimal, the lowest bit for signal 1.
    bool has_in_mask(const std::string& name, int signal) const;

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

Said run_program(const TempFolder& folder, const std::vector<std::string>& arguments,
                 const std::vector<std::string>& environment = {});

// A folder with a small scene, scene.toml, and a mesh, quad.obj.
class AppTest : public testing::Test {
protected:
    AppTest();
    void write(const std::string& name, const std::string& text) const { write_bytes(folder_.file(name), text); }
    std::string file(const std::string& name) const { return folder_.file(name); }
    bool exists(const std::string& name) const { return std::filesystem::exists(file(name)); }

    Said run(const std::vector<std::string>& arguments, const std::vector<std::string>& environment = {}) const
    {
        return run_program(folder_, arguments, environment);
    }
    // Renders scene.toml at 24x16 with 4 samples unless the arguments say something else.
    Said render(std::vector<std::string> arguments) const;
    Image image(const std::string& name) const { return read_exr(file(name)); }
    std::string metadata(const std::string& name, const std::string& key) const;

    static const char* const small_scene;
    static const char* const quad;

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
