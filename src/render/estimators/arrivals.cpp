#include "render/estimators/arrivals.h"

#include <algorithm>
#include <cmath>

namespace lancer {
namespace {

constexpr double prior = 16;          // vertices that a cell's surroundings count for
constexpr double outside = 0.005;     // part of the places beyond each end of the grid
constexpr double worthwhile = 1.1;    // gain of rates that must be expected: looking up cells takes time
constexpr double worth_a_choice = 2;  // of a choice by place: that by power is spread better over samples
constexpr double as_before = 0.1;     // part of the choices that are the pilot's, whatever was learned
constexpr int least_weight = 10;      // learned weights are 2^-0 to 2^-least_weight of the largest

// The grid that holds all but the outermost places. Cells and corner are powers of two and multiples of these, so that
// a few more rays seldom move them.
LightChoice make_grid(std::span<const Arrival> arrivals)
{
    std::vector<float> along(arrivals.size());
    const auto cut = static_cast<std::ptrdiff_t>(outside * static_cast<double>(along.size()));
    std::array<float, 3> low{}, high{};
    for (size_t axis = 0; axis < 3; ++axis) {
        std::transform(arrivals.begin(), arrivals.end(), along.begin(),
                       [&](const Arrival& a) { return a.p[static_cast<int>(axis)]; });
        const auto place = [&](std::ptrdiff_t i) {
            std::nth_element(along.begin(), along.begin() + i, along.end());
            return along[static_cast<size_t>(i)];
        };
        low[axis] = place(cut), high[axis] = place(static_cast<std::ptrdiff_t>(along.size()) - 1 - cut);
    }
    LightChoice grid;
    const float extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
    if (!(extent > 0)) return grid;
    // One more cell than fits, as the corner is rounded down.
    const float cell = std::exp2(std::ceil(std::log2(extent / (LightChoice::most_cells - 1))));
    grid.per_unit = 1 / cell;
    for (size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::floor(low[axis] / cell) * cell;
        const float cells = std::floor((high[axis] - low[axis]) / cell) + 1;
        grid.size[axis] = std::min(LightChoice::most_cells, static_cast<uint32_t>(cells));
    }
    grid.low = {low[0], low[1], low[2]};
    return grid;
}

// Sums of a cell: its vertices, and for each light the squares of what shadow rays brought.
class Level {
public:
    Level(std::array<uint32_t, 3> size, size_t lights)
        : size_(size), lights_(lights), sums_(size_t{6} * size[0] * size[1] * size[2] * (lights + 1))
    {
    }
    std::span<double> of(size_t cell) { return std::span(sums_).subspan(cell * (lights_ + 1), lights_ + 1); }
    size_t cell_of(uint32_t x, uint32_t y, uint32_t z, uint32_t side) const
    {
        return ((size_t{z} * size_[1] + y) * size_[0] + x) * 6 + side;
    }
    bool is_coarsest() const { return size_[0] == 1 && size_[1] == 1 && size_[2] == 1; }
    // Cells twice as long, with the same normals.
    Level coarser()
    {
        Level to({(size_[0] + 1) / 2, (size_[1] + 1) / 2, (size_[2] + 1) / 2}, lights_);
        for_each([&](uint32_t x, uint32_t y, uint32_t z, uint32_t side) {
            const auto from = of(cell_of(x, y, z, side)), sum = to.of(to.cell_of(x / 2, y / 2, z / 2, side));
            for (size_t i = 0; i <= lights_; ++i) sum[i] += from[i];
        });
        return to;
    }
    template <class F>
    void for_each(const F& f) const
    {
        for (uint32_t z = 0; z < size_[2]; ++z)
            for (uint32_t y = 0; y < size_[1]; ++y)
                for (uint32_t x = 0; x < size_[0]; ++x)
                    for (uint32_t side = 0; side < 6; ++side) f(x, y, z, side);
    }

private:
    std::array<uint32_t, 3> size_;
    size_t lights_;
    std::vector<double> sums_;
};

// The rate q with the least variance for the work. Light sampling of mean square s and a work of 1 adds s / q to the
// variance v of a sample and q to its work w: the derivative of (v + s / q) (w + q) is 0 at q^2 = s w / v.
uint8_t exponent_for(double mean_square, double work_per_variance)
{
    const double q2 = mean_square * work_per_variance;
    if (!(q2 > 0)) return LightChoice::lowest;
    return static_cast<uint8_t>(std::clamp(std::round(-0.5 * std::log2(q2)), 0.0, double{LightChoice::lowest}));
}

// Probabilities in proportion to the roots of mean squares, which has the least variance.
void choose_by(std::span<const double> squares, const LightChoice& by, std::span<double> probability)
{
    const double most = std::sqrt(*std::max_element(squares.begin(), squares.end()));
    double total = 0;
    for (size_t i = 0; i < squares.size(); ++i) {
        const double weight = most > 0 ? std::sqrt(squares[i]) / most : 0;
        probability[i] = weight > 0 ? std::exp2(std::round(std::max(double{-least_weight}, std::log2(weight)))) : 0;
        total += probability[i];
    }
    for (size_t i = 0; i < squares.size(); ++i) {
        const double before = double{by.probability(0, static_cast<uint32_t>(i))};
        probability[i] = total > 0 ? as_before * before + (1 - as_before) * probability[i] / total : before;
    }
}

void append_sums(std::span<const double> probability, std::vector<float>& cumulative)
{
    double sum = 0;
    for (const double p : probability) cumulative.push_back(static_cast<float>(sum += p));
    cumulative.back() = 1;
}

bool is_chosen_by_place(const LightTable& lights)
{
    return !lights.tree && lights.pick.size() > 1 && lights.pick.size() <= LightChoice::most_lights;
}

}  // namespace

LightChoice choice_of_pilot(const LightTable& lights)
{
    LightChoice choice;
    if (!is_chosen_by_place(lights)) return choice;
    choice.lights = static_cast<uint32_t>(lights.pick.size());
    uint32_t shining = 0;
    for (uint32_t i = 0; i < choice.lights; ++i) shining += lights.pick.probability(i) > 0;
    std::vector<double> probability(choice.lights);
    for (uint32_t i = 0; i < choice.lights; ++i)
        if (const double power = double{lights.pick.probability(i)}; power > 0)
            probability[i] = 0.5 * power + 0.5 / shining;
    for (uint32_t side = 0; side < choice.cells(); ++side) {
        choice.exponents.push_back(0);
        append_sums(probability, choice.cumulative);
    }
    return choice;
}

namespace {

double probability_by(const LightChoice& choice, const LightTable& lights, uint32_t cell, uint32_t light)
{
    return double{choice.chooses() ? choice.probability(cell, light) : lights.pick.probability(light)};
}

// Learns from all arrivals for which takes() is true. chooses: also which light.
template <class Takes>
LightChoice learn(std::span<const Arrival> arrivals, const LightTable& lights, const LightChoice& by,
                  const PilotCost& cost, bool chooses, const Takes& takes)
{
    LightChoice learned = make_grid(arrivals);
    if (learned.per_unit == 0) return {};
    const size_t count = by.chooses() ? by.lights : 1;
    std::vector<Level> levels;
    levels.emplace_back(learned.size, count);
    double vertices = 0, sent = 0;
    for (const Arrival& a : arrivals) {
        if (!takes(a)) continue;
        const auto sums = levels[0].of(learned.cell_of(a.p, a.n));
        sums[count] += 1, vertices += 1;
        if (a.light == Scene::none) continue;
        sent += 1;
        // Divided by the probability of the choice once: the mean over all vertices is that if each had chosen it.
        const double chosen = by.chooses() ? double{by.probability(0, a.light)} : 1;
        sums[by.chooses() ? a.light : 0] += double{a.brought} * double{a.brought} * chosen;
    }
    if (sent == 0) return {};
    // A light sample at each vertex costs this many shadow rays.
    const double rays = sent / vertices;
    while (!levels.back().is_coarsest()) levels.push_back(levels.back().coarser());

    std::vector<double> squares(count), probability(count);
    learned.exponents.resize(learned.cells());
    levels[0].for_each([&](uint32_t x, uint32_t y, uint32_t z, uint32_t side) {
        std::fill(squares.begin(), squares.end(), 0);
        for (auto level = static_cast<uint32_t>(levels.size()); level-- > 0;) {
            const auto sums = levels[level].of(levels[level].cell_of(x >> level, y >> level, z >> level, side));
            for (size_t i = 0; i < count; ++i) squares[i] = (sums[i] + prior * squares[i]) / (sums[count] + prior);
        }
        if (chooses) {
            choose_by(squares, by, probability);
            append_sums(probability, learned.cumulative);
        } else {
            for (size_t i = 0; i < count; ++i)
                probability[i] = double{lights.pick.probability(static_cast<uint32_t>(i))};
        }
        double mean_square = by.chooses() ? 0 : squares[0];
        for (size_t i = 0; by.chooses() && i < count; ++i)
            if (squares[i] > 0) mean_square += squares[i] / probability[i];
        learned.exponents[levels[0].cell_of(x, y, z, side)] =
            exponent_for(mean_square / rays, cost.work / cost.variance);
    });
    if (chooses) learned.lights = by.lights;
    return learned;
}

// What light sampling costs by a choice, of those arrivals for which takes() is true: mean squares and shadow rays.
template <class Takes>
PilotCost cost_of(const LightChoice& choice, std::span<const Arrival> arrivals, const LightTable& lights,
                  const LightChoice& by, const Takes& takes)
{
    PilotCost sum{0, 0};
    for (const Arrival& a : arrivals) {
        if (a.light == Scene::none || !takes(a)) continue;
        const uint32_t cell = choice.empty() ? 0 : choice.cell_of(a.p, a.n);
        const double rate = choice.empty() ? 1 : double{choice.rate(cell)};
        const double more =
            by.chooses() ? probability_by(by, lights, 0, a.light) / probability_by(choice, lights, cell, a.light) : 1;
        sum.variance += double{a.brought} * double{a.brought} * more / rate;
        sum.work += rate;
    }
    return sum;
}

}  // namespace

LightChoice learn_light_choice(std::span<const Arrival> arrivals, const LightTable& lights, const LightChoice& by,
                               const PilotCost& cost)
{
    if (arrivals.empty() || !(cost.variance > 0)) return {};
    const auto all = [](const Arrival&) { return true; };
    const auto is_in = [](uint32_t half) { return [half](const Arrival& a) { return (a.slot & 1) == half; }; };
    const PilotCost pilot = cost_of(by, arrivals, lights, by, all);
    // The pilot's cost with other light sampling; no choice of lights takes all variance away.
    const auto with = [&](const PilotCost& sampling) {
        return PilotCost{std::max(cost.variance + sampling.variance - pilot.variance, 0.1 * cost.variance),
                         cost.work + sampling.work - pilot.work};
    };
    // What one half of the pixels teaches is judged by the other.
    const auto judged = [&](bool chooses) {
        PilotCost sum{0, 0};
        for (const uint32_t half : {0u, 1u}) {
            const LightChoice learned = learn(arrivals, lights, by, cost, chooses, is_in(half));
            const PilotCost other = cost_of(learned, arrivals, lights, by, is_in(1 - half));
            sum.variance += other.variance, sum.work += other.work;
        }
        return with(sum);
    };
    const PilotCost by_power = with(cost_of({}, arrivals, lights, by, all));
    if (by.chooses() && by_power.variance > worth_a_choice * judged(true).variance)
        return learn(arrivals, lights, by, cost, true, all);
    const PilotCost rates = judged(false);
    if (!(by_power.variance * by_power.work > worthwhile * rates.variance * rates.work)) return {};
    return learn(arrivals, lights, by, cost, false, all);
}

}  // namespace lancer
