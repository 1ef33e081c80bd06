#include "app/signals.h"

#include <unistd.h>

#include <atomic>
#include <csignal>

#include "app/commands.h"

namespace lancer {
namespace {

std::atomic<int> interrupts{0};
std::atomic<bool> snapshot{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

void on_interrupt(int)
{
    if (interrupts.fetch_add(1) > 0) _exit(exit_interrupted);
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

}  // namespace

Signals::Signals()
{
    handle(SIGINT, on_interrupt);
    handle(SIGTERM, on_interrupt);
    handle(SIGUSR1, on_snapshot);
}

Signals::~Signals()
{
    // On the way out after an interrupt the next one still ends the program with its code, not by the signal.
    if (interrupted()) return;
    for (const int number : {SIGINT, SIGTERM, SIGUSR1}) handle(number, SIG_DFL);
}

void Signals::poll()
{
    if (interrupted()) stop_.request_stop();
}

bool Signals::interrupted() const { return interrupts > 0; }

bool Signals::snapshot_requested() const { return snapshot; }

bool Signals::take_snapshot_request() { return snapshot.exchange(false); }

}  // namespace lancer
