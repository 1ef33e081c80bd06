// Interrupts and snapshot requests. Handlers only set flags; poll() does the rest outside of them.
#pragma once

#include <stop_token>
#include <thread>

namespace lancer {

// From the constructor on, the first SIGINT or SIGTERM asks to stop and the second one ends the program at once;
// SIGHUP, SIGXCPU and SIGUSR2 ask to stop; SIGUSR1 asks for a snapshot. One object in a program.
class Signals {
public:
    Signals();
    ~Signals();
    Signals(const Signals&) = delete;
    Signals& operator=(const Signals&) = delete;

    // Passes an interrupt on to the stop token. Called now and then from any thread.
    void poll();
    std::stop_token stop() const { return stop_.get_token(); }
    bool interrupted() const;
    // Whether a snapshot is asked for that was not taken yet. From any thread.
    bool snapshot_requested() const;
    // True once per request.
    bool take_snapshot_request();

private:
    std::stop_source stop_;
};

// Polls while it lives, where work takes long and has no tiles that would.
class SignalWatch {
public:
    explicit SignalWatch(Signals& signals);

private:
    std::jthread thread_;
};

}  // namespace lancer
