// A display without a screen, for tests of the window: Xvfb, and xdotool, which presses real keys and buttons.
#pragma once

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

namespace lancer {

class XServer {
public:
    // What is missing for it on this machine; empty: nothing.
    static std::string missing()
    {
        for (const char* program : {"Xvfb", "xdotool"})
            if (std::system(("command -v " + std::string(program) + " > /dev/null").c_str()) != 0)
                return std::string(program) + " is not installed";
        return "";
    }
    XServer()
    {
        int ends[2];
        if (pipe(ends) != 0) return;
        pid_ = fork();
        if (pid_ == 0) {
            dup2(ends[1], 1);
            close(ends[0]), close(ends[1]);
            // A number of its own: of two servers that take turns with one, the first to end removes the other's
            // socket. No reset: it would drop who connects just as the last client leaves.
            const std::string display = ":" + std::to_string(1000 + getpid() % 30000);
            execlp("Xvfb", "Xvfb", display.c_str(), "-displayfd", "1", "-screen", "0", "1400x900x24", "-noreset",
                   "-nolisten", "tcp", nullptr);
            _exit(1);
        }
        close(ends[1]);
        char c = 0;
        while (read(ends[0], &c, 1) == 1 && c != '\n') display_ += c;
        close(ends[0]);
    }
    ~XServer()
    {
        if (pid_ <= 0) return;
        kill(pid_, SIGTERM);
        waitpid(pid_, nullptr, 0);
    }
    XServer(const XServer&) = delete;
    XServer& operator=(const XServer&) = delete;

    bool is_there() const { return !display_.empty(); }
    std::string variable() const { return "DISPLAY=:" + display_; }
    // Runs xdotool; whether it did what it was asked for.
    bool tool(const std::string& arguments) const
    {
        return std::system((variable() + " xdotool " + arguments + " > /dev/null 2>&1").c_str()) == 0;
    }

private:
    pid_t pid_ = 0;
    std::string display_;
};

}  // namespace lancer
