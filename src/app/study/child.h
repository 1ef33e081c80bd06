// Child processes: the program itself for each render of a study, so that a crash affects only one, and scripts that
// start other renderers.
#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "app/signals.h"

namespace lancer {

struct ChildOrder {
    std::string program;  // path
    std::string name;     // what it is called; empty: by its path
    std::vector<std::string> arguments;
    std::vector<std::pair<std::string, std::string>> environment;  // besides our own
    double timeout_s = std::numeric_limits<double>::infinity();
};

struct ChildResult {
    int code = 0;  // exit code; 128 + signal if one ended it
    bool timed_out = false;
    std::string out, err;  // what it wrote to the standard output and error
};

// Waits for its end, be its output closed before or kept open after by what it started. It reads nothing and has a
// process group of its own: an interrupt is passed on to all that it started, and what has not ended half a minute
// later, or at the end of its time, is killed. Throws Error (failed) if it cannot be started.
ChildResult run_child(const ChildOrder& order, Signals& signals);

// A path to start this very program as long as it runs, even if its file was replaced.
std::string own_program();
ChildResult run_self(const std::vector<std::string>& arguments, Signals& signals);

}  // namespace lancer
