// The program run again by itself, so that each of many renders begins afresh and none can take the others with it.
#pragma once

#include <string>
#include <vector>

#include "app/signals.h"

namespace lancer {

struct ChildResult {
    int code = 0;     // exit code; 128 + signal if one ended it
    std::string err;  // what it wrote to the standard error
};

// Waits for its end. An interrupt is passed on. Throws Error (failed) if it cannot be started.
ChildResult run_self(const std::vector<std::string>& arguments, Signals& signals);

}  // namespace lancer
