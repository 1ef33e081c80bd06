#include "app/signals.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <mutex>

#include "app/commands/commands.h"

namespace lancer {
namespace {

std::atomic<int> interrupts{0};
std::atomic<bool> snapshot{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

void on_interrupt(int)
{
    if (interrupts.fetch_add(1) > 0) _exit(exit_interrupted);
}
// Batch systems send several of these, as a warning: none ends the program while it writes.
void on_request(int)
{
    int none = 0;
    interrupts.compare_exchange_strong(none, 1);
}
void on_snapshot(int) { snapshot = true; }

void handle(int number, void (*handler)(int))
{
    struct sigaction action = {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, nullptr);
}

// As nohup leaves SIGHUP.
bool is_ignored(int number)
{
    struct sigaction action = {};
    return sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

constexpr std::array requests{SIGHUP, SIGXCPU, SIGUSR2};

}  // namespace

Signals::Signals()
{
    handle(SIGINT, on_interrupt);
    handle(SIGTERM, on_interrupt);
    for (const int number : requests)
        if (!is_ignored(number)) handle(number, on_request);
    handle(SIGUSR1, on_snapshot);
}

Signals::~Signals()
{
    // On the way out after an interrupt the next one still ends the program with its code, not by the signal.
    if (interrupted()) return;
    for (const int number : {SIGINT, SIGTERM, SIGUSR1}) handle(number, SIG_DFL);
    for (const int number : requests)
        if (!is_ignored(number)) handle(number, SIG_DFL);
}

void Signals::poll()
{
    if (interrupted()) stop_.request_stop();
}

bool Signals::interrupted() const { return interrupts > 0; }

bool Signals::snapshot_requested() const { return snapshot; }

SignalWatch::SignalWatch(Signals& signals)
    : thread_([&signals](const std::stop_token& done) {
          std::mutex mutex;
          std::unique_lock lock(mutex);
          std::condition_variable_any ends;
          while (!done.stop_requested()) {
              signals.poll();
              ends.wait_for(lock, done, std::chrono::milliseconds(50), [] { return false; });
          }
      })
{
}

bool Signals::take_snapshot_request() { return snapshot.exchange(false); }

}  // namespace lancer
