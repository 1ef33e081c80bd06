#include "render/denoise/non_local_means.h"

#include "render/denoise/halves.h"

namespace lancer::denoise {
namespace {

// The sums of weights and of weighted values of a part, which one thread fills.
class WeightedSums {
public:
    WeightedSums(const Part& part, size_t planes)
        : part_(part), sums_(planes + 1, std::vector<float>(static_cast<size_t>(part.width() * part.height())))
    {
    }
    void add(std::span<const Plane> planes, int dx, int dy, const std::vector<float>& distances,
             float inverse_k_squared)
    {
        for (int y = 0; y < part_.height(); ++y)
            for (int x = 0; x < part_.width(); x += lanes) {
                const int at = y * part_.width() + x;
                const Float8 w = weight_of(load8_anywhere(distances.data() + at), inverse_k_squared);
                add(0, at, w);
                for (size_t i = 0; i < planes.size(); ++i)
                    add(i + 1, at, w * load8_anywhere(planes[i].row(part_.y0 + y + dy) + part_.x0 + x + dx));
            }
    }
    void store(std::span<Plane> out) const
    {
        for (size_t i = 0; i < out.size(); ++i)
            for (int y = 0; y < part_.height(); ++y)
                for (int x = 0; x < part_.width() && part_.x0 + x < out[i].width(); ++x) {
                    const auto at = static_cast<size_t>(y * part_.width() + x);
                    out[i].row(part_.y0 + y)[part_.x0 + x] = sums_[i + 1][at] / sums_[0][at];
                }
    }

private:
    void add(size_t plane, int at, Float8 x)
    {
        float* const to = sums_[plane].data() + at;
        store8_anywhere(to, load8_anywhere(to) + x);
    }

    Part part_;
    std::vector<std::vector<float>> sums_;
};

}  // namespace

std::vector<Plane> non_local_means(std::span<const Plane> planes, const Guide& guide, const NonLocalMeans& settings)
{
    std::vector<Plane> out;
    for (const Plane& p : planes) out.emplace_back(p.width(), p.height());
    const float inverse_k_squared = 1 / (settings.k * settings.k);
    for_parts(out[0].width(), out[0].height(), 64, 32, [&](Part part) {
        part.x1 = part.x0 + (part.width() + lanes - 1) / lanes * lanes;
        PatchDistance patches(guide, settings.patch_radius);
        std::vector<float> distances(static_cast<size_t>(part.width() * part.height()));
        WeightedSums sums(part, planes.size());
        const int r = settings.window_radius;
        for (int dy = -r; dy <= r; ++dy)
            for (int dx = -r; dx <= r; ++dx) {
                patches.compute(part, dx, dy, 1, distances.data());
                sums.add(planes, dx, dy, distances, inverse_k_squared);
            }
        sums.store(out);
    });
    for (Plane& p : out) p.mirror_edges();
    return out;
}

void filter_features(Halves& halves)
{
    auto& [a, b] = halves.half;
    for (const auto& [first, count] : {std::pair<size_t, size_t>{albedo_at, 3}, {normal_at, 3}, {depth_at, 1}}) {
        const auto of = [&group = first, &size = count](Half& half) {
            return std::span(half.features).subspan(group, size);
        };
        std::vector<Plane> variances;
        for (size_t i = 0; i < count; ++i) variances.push_back(variance_of_pair(of(a)[i], of(b)[i], 2));
        const NonLocalMeans settings{.k = 0.5f};
        std::vector<Plane> filtered_a = non_local_means(of(a), {of(b), variances}, settings);
        std::vector<Plane> filtered_b = non_local_means(of(b), {of(a), variances}, settings);
        std::move(filtered_a.begin(), filtered_a.end(), of(a).begin());
        std::move(filtered_b.begin(), filtered_b.end(), of(b).begin());
    }
}

}  // namespace lancer::denoise
