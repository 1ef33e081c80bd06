// Turns of sessions that render beside each other: each has the machine for itself, and is timed so.
#pragma once

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <stop_token>

namespace lancer {

class Turns {
public:
    // Held while one renders; gives the turn back.
    class Turn {
    public:
        Turn() = default;
        explicit Turn(Turns& turns) : turns_(&turns) {}

    private:
        struct GiveBack {
            void operator()(Turns* turns) const { turns->give_back(); }
        };
        std::unique_ptr<Turns, GiveBack> turns_;
    };

    // Waits until nobody renders and nobody else takes part who has had fewer seconds. Who has taken a turn takes part
    // until leave(), so that the others wait while it gets ready for its next one. Nothing is held if `stop` comes
    // first. who: any address of its own.
    Turn take(const void* who, double seconds, const std::stop_token& stop);
    void leave(const void* who);

private:
    void give_back();

    std::mutex mutex_;
    std::condition_variable_any wake_;
    std::map<const void*, double> seconds_;  // of those who take part
    bool is_taken_ = false;
};

}  // namespace lancer
