#include "stability/counted_render.h"

namespace lancer::stability {

RenderRequest square(uint32_t size, uint32_t spp)
{
    RenderRequest r;
    r.width = r.height = size;
    r.spp = {spp};
    r.threads = 2;
    return r;
}

Film counted_render(const SceneDescription& scene, const RenderRequest& request, Outcome& outcome)
{
    Rendered out = render(scene, request);
    for (const Pixel& p : out.film.pixels) outcome.samples += p.n;
    outcome.samples += out.counters.dropped;
    outcome.dropped += out.counters.dropped;
    return std::move(out.film);
}

double pixels_that_differ(const Film& a, const Film& b)
{
    if (a.pixels.size() != b.pixels.size()) return static_cast<double>(std::max(a.pixels.size(), b.pixels.size()));
    const auto bits = [](double x) { return std::bit_cast<uint64_t>(x); };
    size_t count = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        const Pixel p = a.whole(i), q = b.whole(i);
        bool same = p.n == q.n && bits(p.sum_sq) == bits(q.sum_sq);
        for (size_t c = 0; c < 3; ++c) same = same && bits(p.sum[c]) == bits(q.sum[c]);
        count += !same;
    }
    return static_cast<double>(count);
}

}  // namespace lancer::stability
