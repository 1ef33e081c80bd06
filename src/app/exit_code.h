// Exit codes, as in sysexits where these fit, and the handling of exceptions.
#pragma once

#include <exception>
#include <functional>
#include <string>

namespace lancer {

constexpr int exit_done = 0, exit_failed = 1, exit_usage = 2, exit_invalid = 65, exit_missing = 66, exit_no_memory = 71,
              exit_unfinished = 75, exit_interrupted = 130;

// The exit code of the exception that is being handled, a std::exception, and its message in lines "place: error: ...".
struct Failure {
    int code;
    std::string text;
};
Failure current_failure();

// Runs body and flushes stdout. Returns the result of body, or, if it throws, prints the message and returns the exit
// code of the error's kind.
int guarded(const std::function<int()>& body);

// What to say of an exception that nothing catches; null: of an end without one. Only where memory or threads have run
// out do fewer threads help.
std::string message_of_termination(const std::exception_ptr& thrown);

}  // namespace lancer
