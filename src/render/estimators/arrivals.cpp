#include "render/estimators/arrivals.h"

#include <algorithm>
#include <cmath>

#include "render/estimators/choice_levels.h"

namespace lancer {
namespace {

constexpr double prior = 16;            // vertices that a cell's surroundings count for
constexpr double prior_of_tiles = 128;  // the same for tiles of the sky, of which each vertex finds one at most
constexpr double worthwhile = 1.1;      // gain of rates that must be expected: looking up cells takes time
constexpr double worth_a_choice = 2;    // of a choice by place: that by power is spread better over samples
constexpr double worth_tiles = 1.4;     // of tiles beyond the best without: their samples cost more than others
constexpr double is_rare = 0.8;    // part of mean squares that is variance where a sky of one colour is rarely found
constexpr double fewest = 16;      // vertices of a cell that chooses tiles
constexpr double as_before = 0.1;  // part of the choices that are the pilot's, whatever was learned
constexpr int least_weight = 10;   // learned weights are 2^-0 to 2^-least_weight of the largest

// The rate q with the least variance for the work. Light sampling of mean square s and a work of 1 adds s / q to the
// variance v of a sample and q to its work w: the derivative of (v + s / q) (w + q) is 0 at q^2 = s w / v.
uint8_t exponent_for(double mean_square, double work_per_variance)
{
    const double q2 = mean_square * work_per_variance;
    if (!(q2 > 0)) return LightChoice::lowest;
    return static_cast<uint8_t>(std::clamp(std::round(-0.5 * std::log2(q2)), 0.0, double{LightChoice::lowest}));
}

// Probabilities in proportion to the roots of mean squares, which has the least variance.
// before(i): what they were, which a part of them stays.
template <class Before>
void choose_by(std::span<const double> squares, const Before& before, std::span<double> probability)
{
    const double most = std::sqrt(*std::max_element(squares.begin(), squares.end()));
    double total = 0;
    for (size_t i = 0; i < squares.size(); ++i) {
        const double weight = most > 0 ? std::sqrt(squares[i]) / most : 0;
        probability[i] = weight > 0 ? std::exp2(std::round(std::max(double{-least_weight}, std::log2(weight)))) : 0;
        total += probability[i];
    }
    for (size_t i = 0; i < squares.size(); ++i) {
        const double was = before(static_cast<uint32_t>(i));
        probability[i] = total > 0 ? as_before * was + (1 - as_before) * probability[i] / total : was;
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

// Learns from the arrivals of a pilot, and judges what it learned. Both take all pixels, or every other.
class Lesson {
public:
    enum Pixels : uint32_t { even = 1, odd = 2, all = 3 };

    // What is chosen by place.
    enum class Choosing { nothing, lights, lights_and_tiles };

    Lesson(std::span<const Arrival> arrivals, const LightTable& lights, const LightChoice& pilot, const PilotCost& cost,
           Sky sky)
        : arrivals_(arrivals), lights_(lights), pilot_(pilot), cost_(cost), sky_(sky), grid_(make_grid(arrivals))
    {
        index_.reserve(arrivals.size());
        for (const Arrival& a : arrivals) index_.push_back(grid_.index_of(a.p, a.n));
    }
    bool has_grid() const { return grid_.per_unit > 0; }

    Learned learned(Choosing what, Pixels from) const
    {
        Learned to{.choice = grid_};
        LightChoice& choice = to.choice;
        if (what != Choosing::nothing) choice.lights = lights_of_pilot();
        choice.has_tiles = what == Choosing::lights_and_tiles;
        const size_t count = std::max(choice.options(), lights_of_pilot());
        Level level(grid_.size, count);
        const double rays_per_vertex = add_arrivals(level, choice.has_tiles, from);
        if (rays_per_vertex == 0 && !choice.has_tiles) return {};
        to.levels.push_back(std::move(level));
        while (!to.levels.back().is_coarsest()) to.levels.push_back(to.levels.back().coarser());

        // Means by light and tile, of one cell after the other; nothing is known of the first.
        std::vector<double> squares(count);
        add_cell(choice, squares, rays_per_vertex);
        for (size_t k = to.levels.size(); k-- > 0;) {
            Level& here = to.levels[k];
            const std::vector<size_t> indices = here.indices();
            here.cells.resize(indices.size());
            for (const size_t index : indices) {
                const uint32_t around = k + 1 < to.levels.size() ? to.levels[k + 1].cell(here.above(index)) : 0;
                const std::span<const double> sums = here.sums(index);
                if (choice.has_tiles && sums[count] < fewest) {
                    here.cell(index) = around;
                    continue;
                }
                const size_t cell = squares.size() / count;
                here.cell(index) = static_cast<uint32_t>(cell);
                squares.resize(squares.size() + count);
                const std::span<double> means = std::span(squares).subspan(cell * count, count);
                for (size_t i = 0; i < count; ++i) {
                    const double weight = choice.has_tiles && i >= choice.lights ? prior_of_tiles : prior;
                    means[i] = (sums[i] + weight * squares[around * count + i]) / (sums[count] + weight);
                }
                add_cell(choice, means, rays_per_vertex);
            }
        }
        return to;
    }

    // What light sampling costs by a choice: mean squares and shadow rays. An empty choice is that by power.
    PilotCost cost_of(const Learned& by, Pixels on) const
    {
        PilotCost sum{0, 0};
        for (size_t i = 0; i < arrivals_.size(); ++i) {
            const Arrival& a = arrivals_[i];
            if (!takes(a, on)) continue;
            const uint32_t cell = by.cell_of(index_[i]);
            const double rate = by.choice.exponents.empty() ? 1 : double{by.choice.rate(cell)};
            if (a.tile != Scene::none) {
                // By the balance heuristic, which is close to the power heuristic and has a simple variance.
                const double of_tile = by.choice.has_tiles ? rate * tile_density(by.choice, cell, a.tile) : 0;
                sum.variance += double{a.found} * double{a.found} * double{a.pdf} / (double{a.pdf} + of_tile);
            }
            const double of_tiles = by.choice.has_tiles ? share_of_tiles(by.choice, cell) : 0;
            sum.work += rate * (a.light == Scene::none ? of_tiles : 1);
            if (a.light == Scene::none) continue;
            if (by.choice.has_tiles && replaces_sky()) {
                sum.variance += double{a.brought} * double{a.brought};
                continue;
            }
            const double more = probability_of_pilot(pilot_option(a)) / probability(by.choice, cell, pilot_option(a));
            sum.variance += double{a.brought} * double{a.brought} * more / rate;
        }
        return sum;
    }

private:
    static bool takes(const Arrival& a, Pixels from) { return ((a.slot & 1) == 0 ? even : odd) & from; }

    // Returns the shadow rays per vertex, which is what a light sample at each vertex costs; 0 if there is none.
    double add_arrivals(Level& level, bool with_tiles, Pixels from) const
    {
        double vertices = 0, sent = 0;
        for (size_t i = 0; i < arrivals_.size(); ++i) {
            const Arrival& a = arrivals_[i];
            if (!takes(a, from)) continue;
            const std::span<double> sums = level.sums(index_[i]);
            sums.back() += 1, vertices += 1;
            // What a sample of the tile brings: the density of BSDF sampling over the tile's.
            if (with_tiles && a.tile != Scene::none)
                sums[lights_of_pilot() + a.tile] +=
                    double{a.found} * double{a.found} * double{a.pdf} / double{SkyTiles::pdf};
            if (a.light == Scene::none || (with_tiles && replaces_sky())) continue;
            sent += 1;
            // Divided by the probability of the choice once: the mean over all vertices is that if each had chosen it.
            const uint32_t light = pilot_option(a);
            sums[light] += double{a.brought} * double{a.brought} * probability_of_pilot(light);
        }
        return sent > 0 ? sent / vertices : 0;
    }
    // Appends a cell, by the mean square of what each light and tile brings.
    void add_cell(LightChoice& choice, std::span<const double> squares, double rays_per_vertex) const
    {
        double mean_square = squares[0];
        if (squares.size() > 1) {
            std::vector<double> chosen(squares.size());
            if (choice.chooses()) {
                choose_by(
                    squares, [&](uint32_t i) { return replaces_sky() ? 0 : probability_of_pilot(i); }, chosen);
                append_sums(chosen, choice.cumulative);
            } else {
                for (uint32_t i = 0; i < chosen.size(); ++i) chosen[i] = double{lights_.pick.probability(i)};
            }
            mean_square = 0;
            for (size_t i = 0; i < squares.size(); ++i)
                if (squares[i] > 0) mean_square += squares[i] / chosen[i];
        }
        // Nearly all samples of tiles send a ray: tiles are where rays left.
        if (choice.has_tiles) {
            const auto cell = static_cast<uint32_t>(choice.exponents.size());
            rays_per_vertex += (1 - rays_per_vertex) * share_of_tiles(choice, cell);
        }
        choice.exponents.push_back(exponent_for(mean_square / rays_per_vertex, cost_.work / cost_.variance));
    }
    uint32_t lights_of_pilot() const { return pilot_.chooses() ? pilot_.lights : 1; }
    // Whether tiles leave nothing to sampling all of the sky: by the cosine BSDF sampling finds a constant sky as well.
    bool replaces_sky() const { return sky_ == Sky::alone; }
    // That the pilot chose a light; it left the tiles to BSDF sampling.
    double probability_of_pilot(uint32_t option) const
    {
        if (option >= lights_of_pilot()) return 0;
        return pilot_.chooses() ? double{pilot_.probability(0, option)} : 1;
    }
    // A lesson about very many lights takes them for one.
    uint32_t pilot_option(const Arrival& a) const { return pilot_.chooses() ? a.light : 0; }
    static double share_of_tiles(const LightChoice& choice, uint32_t cell)
    {
        return 1 - double{choice.cumulative[size_t{cell} * choice.options() + choice.lights - 1]};
    }
    static double tile_density(const LightChoice& choice, uint32_t cell, uint32_t tile)
    {
        return double{choice.probability(cell, choice.lights + tile)} * double{SkyTiles::pdf};
    }
    double probability(const LightChoice& choice, uint32_t cell, uint32_t light) const
    {
        if (choice.chooses()) return double{choice.probability(cell, light)};
        return pilot_.chooses() ? double{lights_.pick.probability(light)} : 1;
    }

    std::span<const Arrival> arrivals_;
    const LightTable& lights_;
    const LightChoice& pilot_;
    PilotCost cost_;
    Sky sky_;
    LightChoice grid_;           // without cells
    std::vector<size_t> index_;  // of each arrival in it
};

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
    choice.cell_at.assign(LightChoice::indices_in(choice.size), 0);
    choice.exponents.push_back(0);
    append_sums(probability, choice.cumulative);
    return choice;
}

LightChoice learn_light_choice(std::span<const Arrival> arrivals, const LightTable& lights, const LightChoice& by,
                               const PilotCost& cost, Sky sky)
{
    using Choosing = Lesson::Choosing;
    if (arrivals.empty() || !(cost.variance > 0)) return {};
    const Lesson lesson(arrivals, lights, by, cost, sky);
    if (!lesson.has_grid()) return {};
    const PilotCost pilot = lesson.cost_of({.choice = by}, Lesson::all);
    // The pilot's cost with other light sampling; no choice of lights takes all variance away.
    const auto with = [&](const PilotCost& sampling) {
        return PilotCost{std::max(cost.variance + sampling.variance - pilot.variance, 0.1 * cost.variance),
                         cost.work + sampling.work - pilot.work};
    };
    // What one half of the pixels teaches is judged by the other.
    const auto judged = [&](Choosing what) {
        const PilotCost a = lesson.cost_of(lesson.learned(what, Lesson::even), Lesson::odd);
        const PilotCost b = lesson.cost_of(lesson.learned(what, Lesson::odd), Lesson::even);
        return with({a.variance + b.variance, a.work + b.work});
    };
    const PilotCost by_power = with(lesson.cost_of({}, Lesson::all));
    Choosing best = Choosing::nothing;
    PilotCost least = judged(best);
    if (by.chooses())
        if (const PilotCost chosen = judged(Choosing::lights); by_power.variance > worth_a_choice * chosen.variance)
            best = Choosing::lights, least = chosen;
    // Where BSDF samples find a sky of one colour often, mean squares are no variances, and their directions are spread
    // better over samples than tiles are.
    const bool tries_tiles = sky == Sky::pictured || (sky != Sky::none && cost.variance > is_rare * pilot.variance);
    if (tries_tiles && (by.chooses() || lights.pick.size() == 1))
        if (const PilotCost tiled = judged(Choosing::lights_and_tiles);
            least.variance * least.work > worth_tiles * tiled.variance * tiled.work)
            best = Choosing::lights_and_tiles;
    if (best == Choosing::nothing && !(by_power.variance * by_power.work > worthwhile * least.variance * least.work))
        return {};
    return lesson.learned(best, Lesson::all).finished();
}

}  // namespace lancer
