// How programs end: their exit codes, as of sysexits where these fit, and what becomes of what is thrown.
#pragma once

#include <exception>
#include <functional>
#include <string>

namespace lancer {

constexpr int exit_done = 0, exit_failed = 1, exit_usage = 2, exit_invalid = 65, exit_missing = 66,
              exit_interrupted = 130;

// Runs body and flushes what it printed. The exit code is what it returns; if it throws, the message is printed as a
// problem and the exit code says of which kind it was.
int guarded(const std::function<int()>& body);

// What to say of an exception that nothing catches; null: of an end without one. Only where memory or threads have run
// out do fewer threads help.
std::string message_of_termination(const std::exception_ptr& thrown);

}  // namespace lancer
