// Features and data that a scene does not use, and what that saves. For reports only.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lancer {

struct UnusedFeature {
    std::string what;    // a plural that follows the count: "constant textures"
    uint64_t count = 0;  // number of them, >= 1
    uint64_t bytes = 0;  // memory that is saved; 0: almost none, or unknown
};

// A list in the order of insertion.
class UnusedFeatures {
public:
    // Adds to the entry with the same text; ignores count 0.
    void add(std::string_view what, uint64_t count, uint64_t bytes = 0)
    {
        if (count == 0) return;
        auto it = std::find_if(all_.begin(), all_.end(), [&](const UnusedFeature& l) { return l.what == what; });
        if (it == all_.end()) it = all_.insert(it, {std::string(what), 0, 0});
        it->count += count, it->bytes += bytes;
    }
    const std::vector<UnusedFeature>& all() const { return all_; }

private:
    std::vector<UnusedFeature> all_;
};

}  // namespace lancer
