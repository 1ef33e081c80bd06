#include "report/metrics/worst_blocks.h"

#include <algorithm>
#include <cmath>

#include "report/metrics/metrics.h"

namespace lancer {
namespace {

// Cuts [begin, end) into parts of at most `side`, all as equal as there is.
std::vector<int32_t> cuts(int32_t begin, int32_t end, int32_t side)
{
    const int32_t size = end - begin, parts = (size + side - 1) / side;
    std::vector<int32_t> places;
    for (int32_t i = 0; i <= parts; ++i)
        places.push_back(begin + static_cast<int32_t>(static_cast<int64_t>(size) * i / parts));
    return places;
}

struct ScoredBlock {
    Window window;
    double score = 0;
};

}  // namespace

std::vector<Window> worst_blocks(const Image& reference, const std::vector<const Image*>& pictures, int32_t side,
                                 size_t count)
{
    if (pictures.empty()) return {};
    std::vector<ScoredBlock> blocks;
    const Window& all = reference.data;
    const std::vector<int32_t> xs = cuts(all.x0, all.x1, side), ys = cuts(all.y0, all.y1, side);
    for (size_t j = 0; j + 1 < ys.size(); ++j)
        for (size_t i = 0; i + 1 < xs.size(); ++i) blocks.push_back({{xs[i], ys[j], xs[i + 1], ys[j + 1]}, 0});
    for (const Image* picture : pictures) {
        const std::vector<double> errors = relative_squared_errors(*picture, reference);
        double total = 0;
        for (const double e : errors) total += e;
        if (!(total > 0) || std::isinf(total)) continue;
        for (ScoredBlock& block : blocks) {
            double sum = 0;
            for (int32_t y = block.window.y0; y < block.window.y1; ++y)
                for (int32_t x = block.window.x0; x < block.window.x1; ++x)
                    sum += errors[static_cast<size_t>(y - all.y0) * static_cast<size_t>(all.width()) +
                                  static_cast<size_t>(x - all.x0)];
            block.score += sum / static_cast<double>(block.window.area()) / total;
        }
    }
    std::stable_sort(blocks.begin(), blocks.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
    std::vector<Window> worst;
    for (const ScoredBlock& block : blocks)
        if (worst.size() < count && block.score > 0) worst.push_back(block.window);
    return worst;
}

Image part_of(const Image& image, const Window& window)
{
    Image part = make_image(window.width(), window.height());
    for (int32_t y = 0; y < window.height(); ++y)
        for (int32_t x = 0; x < window.width(); ++x) part.at(x, y) = image.at(window.x0 + x, window.y0 + y);
    return part;
}

}  // namespace lancer
