#include "app/bench/schedule.h"

namespace lancer {

void run_parts(std::vector<BenchPart>& parts, double end, const std::function<double()>& now,
               const std::function<bool()>& is_stopped)
{
    std::vector<double> used(parts.size()), last(parts.size());
    for (size_t i = 0; i < parts.size(); ++i) last[i] = parts[i].expected;
    const auto comes_before = [&](size_t a, size_t b) {
        if (parts[a].steps == 0 || parts[b].steps == 0) return parts[a].steps == 0 && parts[b].steps > 0;
        return used[a] / parts[a].weight < used[b] / parts[b].weight;
    };
    while (!is_stopped()) {
        const double begin = now();
        size_t next = parts.size();
        for (size_t i = 0; i < parts.size(); ++i)
            if (begin + last[i] <= end && begin < end && (next == parts.size() || comes_before(i, next))) next = i;
        if (next == parts.size()) return;
        parts[next].step();
        ++parts[next].steps;
        last[next] = now() - begin;
        used[next] += last[next];
    }
}

}  // namespace lancer
