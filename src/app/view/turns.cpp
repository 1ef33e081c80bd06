#include "app/view/turns.h"

#include <algorithm>

namespace lancer {

Turns::Turn Turns::take(const void* who, double seconds, const std::stop_token& stop)
{
    std::unique_lock lock(mutex_);
    seconds_[who] = seconds;
    wake_.notify_all();
    const auto is_next = [&] {
        return !is_taken_ && std::all_of(seconds_.begin(), seconds_.end(),
                                         [&](const auto& other) { return other.second >= seconds; });
    };
    if (!wake_.wait(lock, stop, is_next)) return {};
    is_taken_ = true;
    return Turn(*this);
}

void Turns::leave(const void* who)
{
    {
        const std::lock_guard lock(mutex_);
        seconds_.erase(who);
    }
    wake_.notify_all();
}

void Turns::give_back()
{
    {
        const std::lock_guard lock(mutex_);
        is_taken_ = false;
    }
    wake_.notify_all();
}

}  // namespace lancer
