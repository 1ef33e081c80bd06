#include "support/watertight.h"

namespace lancer {

uint64_t count_misses(const Accelerator& accel, const RaysFromInside& rays, Aim aim, Asked asked, uint64_t first,
                      uint64_t count)
{
    constexpr uint64_t batch = 64, chunk = 64 * batch;
    std::atomic<uint64_t> misses{0};
    parallel_for((count + chunk - 1) / chunk, [&](size_t c) {
        std::array<Ray, batch> ray;
        std::array<Hit, batch> hits;
        std::array<uint8_t, batch> occluded;
        uint64_t lost = 0;
        const uint64_t end = std::min(count, (c + 1) * chunk);
        for (uint64_t from = c * chunk; from < end; from += batch) {
            const size_t n = std::min<uint64_t>(batch, end - from);
            for (size_t i = 0; i < n; ++i) ray[i] = rays.ray(aim, first + from + i);
            const std::span<const Ray> all(ray.data(), n);
            const std::span<Hit> found(hits.data(), n);
            const std::span<uint8_t> seen(occluded.data(), n);
            const Coherence coherence = from / batch % 2 ? Coherence::coherent : Coherence::incoherent;
            if (asked == Asked::singly)
                for (size_t i = 0; i < n; ++i) found[i] = accel.closest(all[i]);
            if (asked == Asked::in_batches) accel.closest(all, found, coherence);
            if (asked == Asked::any)
                for (size_t i = 0; i < n; ++i) seen[i] = accel.any(all[i]);
            if (asked == Asked::any_in_batches) accel.any(all, seen);
            const bool whole = asked == Asked::singly || asked == Asked::in_batches;
            for (size_t i = 0; i < n; ++i) lost += whole ? !found[i] || !std::isfinite(found[i].t) : !seen[i];
        }
        misses += lost;
    });
    return misses;
}

}  // namespace lancer
