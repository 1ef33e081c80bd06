#include "report/outliers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "core/film.h"
#include "core/parallel.h"
#include "render/renderer.h"
#include "report/metrics/metrics.h"
#include "scene/camera.h"

namespace lancer {
namespace {

// Samples that are traced again: enough for shares of the error to a few per cent.
constexpr uint64_t samples_of_sources = 16384;
constexpr size_t pixels_at_once = 64;

// By the number of surfaces between light and camera, by where the light comes from, and by what found it.
constexpr std::array<std::string_view, 3> surfaces{"seen", "direct", "indirect"};
constexpr std::array<std::string_view, 2> origins{"lamps", "sky"}, techniques{"bounces", "light sampling"};
constexpr size_t class_count = surfaces.size() * origins.size() * techniques.size();
constexpr uint32_t no_material = UINT32_MAX;

size_t class_of(uint32_t depth, bool is_sky, bool is_sampled)
{
    return (std::min<size_t>(depth, 2) * 2 + size_t{is_sky}) * 2 + size_t{is_sampled};
}
std::string class_name(size_t c)
{
    const size_t surface = c / 4;
    std::string name = std::string(surfaces[surface]) + ", " + std::string(origins[c / 2 % 2]);
    return surface == 0 ? name : name + ", " + std::string(techniques[c % 2]);
}

// Luminance of a sample, and of what each class brings to it.
struct Parts {
    double sum = 0;
    std::array<double, class_count> of{};
    uint32_t material = no_material;
};

struct PixelError {
    uint32_t x = 0, y = 0, n = 0;
    double mean = 0;
    double weight = 0;  // of a squared residual in the error
    double error = 0;   // that of all samples of the pixel
};

class Search {
public:
    Search(const Renderer& renderer, const Camera& camera, const Film& film)
        : renderer_(renderer), camera_(camera), film_(film)
    {
        for (uint32_t y = film.crop.y0; y < film.crop.y1; ++y)
            for (uint32_t x = film.crop.x0; x < film.crop.x1; ++x) {
                const Pixel p = film.whole(film.index(x, y));
                if (p.n < 2) continue;
                const double n = p.n, mean = lancer::luminance(p.sum[0], p.sum[1], p.sum[2]) / n;
                const double weight = 1 / (n * (n - 1) * (mean * mean + relmse_epsilon));
                const double error = std::max(0.0, p.sum_sq - n * mean * mean) * weight;
                if (error > 0) pixels_.push_back({x, y, p.n, mean, weight, error});
                total_ += error > 0 ? error : 0;
            }
    }
    ErrorSources sources(size_t count)
    {
        ErrorSources s;
        if (pixels_.empty()) return s;
        find_shares(s);  // before the pixels are sorted
        find_outliers(count, s);
        return s;
    }

private:
    double value(const PixelError& p, uint32_t sample) const
    {
        static const PathListener silent{[](const PathState&, const Hit&) {}, [](const PathState&, const Surface&) {},
                                         [](const PathState&, Color) {}, [](const Ray&, Color, bool) {}};
        const Color c = renderer_.replay(camera_, film_.width, film_.height, {p.x, p.y, sample}, silent);
        return is_finite(c) ? double{luminance(c)} : p.mean;
    }
    // Shadow rays of a depth are reported after the vertices of that depth and before the next.
    Parts parts(const PixelError& p, uint32_t sample) const
    {
        Parts parts;
        uint32_t depth = 0;
        bool has_hit = false;
        const PathListener listener{
            [&](const PathState&, const Hit& h) { has_hit = bool(h); },
            [&](const PathState& s, const Surface& at) {
                depth = s.depth;
                if (depth == 0) parts.material = at.material;
            },
            [&](const PathState& s, Color c) { parts.of[class_of(s.depth, !has_hit, false)] += double{luminance(c)}; },
            [&](const Ray& r, Color c, bool occluded) {
                if (!occluded) parts.of[class_of(depth + 1, !std::isfinite(r.t_max), true)] += double{luminance(c)};
            },
            [&](const Ray& r, Color c, bool occluded) {
                if (!occluded) parts.of[class_of(depth + 2, !std::isfinite(r.t_max), true)] += double{luminance(c)};
            }};
        const Color c = renderer_.replay(camera_, film_.width, film_.height, {p.x, p.y, sample}, listener);
        parts.sum = is_finite(c) ? double{luminance(c)} : p.mean;
        return parts;
    }
    std::string name_of(uint32_t material) const
    {
        return material == no_material ? "" : renderer_.scene().material_names[material];
    }

    // Pixels at equal steps of the sum of errors, so that each stands for the same part of it.
    void find_shares(ErrorSources& s) const
    {
        const size_t count = std::clamp<size_t>(samples_of_sources / pixels_[0].n, 16, 256);
        std::vector<size_t> chosen;
        double sum = 0;
        for (size_t i = 0; i < pixels_.size(); ++i) {
            sum += pixels_[i].error;
            while (chosen.size() < count && sum * double(count) >= (double(chosen.size()) + 0.5) * total_)
                chosen.push_back(i);
        }
        struct Of {
            std::array<double, class_count> classes{};
            std::map<uint32_t, double> materials;
            double all = 0;
        };
        std::vector<Of> of(chosen.size());
        parallel_for(chosen.size(), [&](size_t k) {
            const PixelError& p = pixels_[chosen[k]];
            for (uint32_t i = 0; i < p.n; ++i) {
                const Parts parts = this->parts(p, i);
                const double residual = parts.sum - p.mean;
                for (size_t c = 0; c < class_count; ++c) of[k].classes[c] += parts.of[c] * residual;
                of[k].materials[parts.material] += residual * residual;
                of[k].all += residual * residual;
            }
        });
        std::array<double, class_count> classes{};
        std::map<uint32_t, double> materials;
        double used = 0;
        for (const Of& o : of) {
            if (o.all <= 0) continue;
            ++used;
            for (size_t c = 0; c < class_count; ++c) classes[c] += o.classes[c] / o.all;
            for (const auto& [m, share] : o.materials) materials[m] += share / o.all;
        }
        for (size_t c = 0; c < class_count; ++c)
            if (classes[c] != 0) s.classes.push_back({class_name(c), classes[c] / used});
        for (const auto& [m, share] : materials)
            s.materials.push_back({m == no_material ? "background" : name_of(m), share / used});
        const auto is_larger = [](const ErrorShare& a, const ErrorShare& b) { return a.share > b.share; };
        std::stable_sort(s.classes.begin(), s.classes.end(), is_larger);
        std::stable_sort(s.materials.begin(), s.materials.end(), is_larger);
    }

    // A residual is at most the error of its pixel: pixels are searched from the largest error down, until the next
    // cannot hold a larger one than those found, or a sixteenth of the picture has been traced again.
    void find_outliers(size_t count, ErrorSources& s)
    {
        std::stable_sort(pixels_.begin(), pixels_.end(),
                         [](const PixelError& a, const PixelError& b) { return a.error > b.error; });
        uint64_t samples = 0, most = 0;
        for (const PixelError& p : pixels_) most += p.n;
        most = std::max<uint64_t>(most / 16, samples_of_sources);
        size_t next = 0;
        while (next < pixels_.size() && samples < most &&
               (s.outliers.size() < count || s.outliers.back().share * total_ < pixels_[next].error)) {
            const size_t first = next, n = std::min(pixels_at_once, pixels_.size() - first);
            std::vector<std::vector<Outlier>> found(n);
            parallel_for(n, [&](size_t k) {
                const PixelError& p = pixels_[first + k];
                for (uint32_t i = 0; i < p.n; ++i) {
                    const double v = value(p, i), residual = v - p.mean;
                    found[k].push_back({{p.x, p.y, i}, v, p.mean, residual * residual * p.weight / total_, {}, {}});
                }
                keep_largest(found[k], count);
            });
            for (size_t k = 0; k < n; ++k) {
                s.outliers.insert(s.outliers.end(), found[k].begin(), found[k].end());
                samples += pixels_[first + k].n;
            }
            keep_largest(s.outliers, count);
            next += n;
        }
        if (s.outliers.size() == count) s.others_at_most = s.outliers.back().share;
        if (next < pixels_.size()) s.others_at_most = std::max(s.others_at_most, pixels_[next].error / total_);
        for (Outlier& o : s.outliers) {
            const auto is_pixel = [&](const PixelError& p) { return p.x == o.id.x && p.y == o.id.y; };
            const Parts parts = this->parts(*std::find_if(pixels_.begin(), pixels_.end(), is_pixel), o.id.sample);
            const auto most_of = std::max_element(parts.of.begin(), parts.of.end());
            o.light = *most_of > 0 ? class_name(static_cast<size_t>(most_of - parts.of.begin())) : "none";
            o.material = name_of(parts.material);
        }
    }
    static bool is_larger(const Outlier& a, const Outlier& b)
    {
        return a.share != b.share ? a.share > b.share : a.id < b.id;
    }
    static void keep_largest(std::vector<Outlier>& of, size_t count)
    {
        std::sort(of.begin(), of.end(), is_larger);
        if (of.size() > count) of.resize(count);
    }

    const Renderer& renderer_;
    const Camera& camera_;
    const Film& film_;
    std::vector<PixelError> pixels_;
    double total_ = 0;
};

}  // namespace

ErrorSources find_error_sources(const Renderer& renderer, const Camera& camera, const Film& film, size_t count)
{
    return Search(renderer, camera, film).sources(count);
}

}  // namespace lancer
