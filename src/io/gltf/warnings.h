// What is left out of a glTF file: one warning for each kind, with the first place and how many there are.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/error.h"

namespace lancer {

class GltfWarnings {
public:
    // True for the first of its kind, of which note() must then tell the place.
    bool count(const std::string& kind, uint64_t times = 1)
    {
        const auto [entry, is_new] = index_.try_emplace(kind, all_.size());
        if (is_new) all_.push_back({kind, {}, 0});
        all_[entry->second].times += times;
        return is_new;
    }
    void note(std::string path) { all_.back().path = std::move(path); }

    // In the order of their first places.
    void tell(const std::string& file, Diagnostics& diagnostics) const
    {
        for (const Kind& k : all_)
            diagnostics.warning({file, 0, 0}, (k.path.empty() ? "" : k.path + ": ") + k.what, k.times);
    }

private:
    struct Kind {
        std::string what, path;
        uint64_t times;
    };
    std::vector<Kind> all_;
    std::map<std::string, size_t> index_;
};

}  // namespace lancer
