// What a scene does without, and what that saves: kept for people to read, nothing depends on it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lancer {

struct UnusedFeature {
    std::string what;    // in words that a number goes before: "textures of one value"
    uint64_t count = 0;  // of them, >= 1
    uint64_t bytes = 0;  // of memory that they would have taken; 0: next to none, or it is not known
    std::string time{};  // that it would have taken, as the bench found it: "250 ms"; empty: none, or it is not known
};

// In the order in which things were first left out.
class UnusedFeatures {
public:
    // More of the same add up; nothing happens where count is 0.
    void add(std::string_view what, uint64_t count, uint64_t bytes = 0, std::string_view time = {})
    {
        if (count == 0) return;
        auto it = std::find_if(all_.begin(), all_.end(), [&](const UnusedFeature& l) { return l.what == what; });
        if (it == all_.end()) it = all_.insert(it, {std::string(what), 0, 0, std::string(time)});
        it->count += count, it->bytes += bytes;
    }
    const std::vector<UnusedFeature>& all() const { return all_; }

private:
    std::vector<UnusedFeature> all_;
};

}  // namespace lancer
