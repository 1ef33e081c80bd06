#include "report/study/tables.h"

#include <algorithm>
#include <cmath>

#include "report/page/number_text.h"
#include "report/study/ranking.h"

namespace lancer {
namespace {

Cell number(double x) { return {std::isnan(x) ? "" : std::isinf(x) ? "infinite" : significant(x), true}; }

std::string target_text(double target) { return round_text(target); }

std::string interval_text(const Interval& i, const std::string& low, const std::string& high)
{
    return " [" + (i.low > 0 ? significant(i.low) : low) + " .. " + (std::isinf(i.high) ? high : significant(i.high)) +
           "]";
}

std::string ratio_text(const Comparison& c)
{
    return std::isnan(c.ratio) ? "" : "×" + significant(c.ratio) + interval_text(c.interval, "0", "open");
}

Tone tone_of(const Comparison& c)
{
    return c.rank == Rank::faster ? Tone::good : c.rank == Rank::slower ? Tone::bad : Tone::plain;
}

Cell comparison_cell(const Comparison& c)
{
    const std::string ratio = c.rank == Rank::baseline ? "" : ratio_text(c);
    // Reasons are long: they may be broken.
    return {ratio + (ratio.empty() ? "" : "\n") + rank_text(c), c.rank != Rank::not_ranked, tone_of(c)};
}

// Of one figure at the end of each run.
double at_end(const SceneFigures& f, const StudyMethod& method, const auto& figure)
{
    std::vector<double> values;
    for (const StudyRun* run : runs_of(f.study, f.scene.name, method.name))
        values.push_back(figure(run->points.back()));
    const bool all = std::none_of(values.begin(), values.end(), [](double v) { return std::isnan(v); });
    return values.empty() || !all ? no_number : median(std::move(values));
}

Table targets_table(const std::string& caption, const std::string& words)
{
    Table table{caption, {"method"}, {}};
    for (const double target : study_targets) table.head.push_back(words + target_text(target));
    return table;
}

}  // namespace

Cell method_cell(const StudyMethod& method)
{
    std::string text = method.name;
    for (size_t i = 0; i < method.biases.size(); ++i) text += (i ? ", " : "\nbiased: ") + method.biases[i];
    return {text};
}

std::string time_text(const TimeToError& t)
{
    const std::string value = significant(t.seconds) + interval_text(t.interval, "at once", "not reached");
    switch (t.reach) {
        case Reach::measured:
            return value;
        case Reach::extrapolated:
            return value + "\nextrapolated";
        case Reach::at_once:
            return "before " + significant(t.seconds);
        default:
            return why_no_time(t.reach);
    }
}

Table times_table(const SceneFigures& f)
{
    Table table = targets_table("Seconds of rendering to an error, medians [95 %]", "s to relMSE ");
    table.head.push_back("s to FLIP " + target_text(flip_target));
    for (const MethodFigures& m : f.all) {
        std::vector<Cell> cells{method_cell(*m.method)};
        for (const TimeToError& t : m.times) cells.push_back({time_text(t), true});
        cells.push_back({time_text(m.flip_time), true});
        table.rows.push_back(std::move(cells));
    }
    return table;
}

Table speed_up_table(const SceneFigures& f)
{
    Table table =
        targets_table("At equal error: time of " + f.study.baseline + " over that of the method [95 %]", "at relMSE ");
    for (const MethodFigures& m : f.all) {
        std::vector<Cell> cells{method_cell(*m.method)};
        for (const double target : study_targets)
            cells.push_back(comparison_cell(speed_up(f.study, f.scene, *m.method, target)));
        table.rows.push_back(std::move(cells));
    }
    return table;
}

Table efficiency_table(const SceneFigures& f)
{
    Table table{"At equal time: efficiency 1 / (relMSE · s) and its gain over " + f.study.baseline + " [95 %]",
                {"method", "at s", "efficiency, 1/s", "that of " + f.study.baseline, "gain", "verdict"},
                {}};
    for (const MethodFigures& m : f.all) {
        const Efficiency e = efficiency_of(f.study, f.scene, *m.method);
        const std::string value =
            std::isnan(e.value) ? "" : significant(e.value) + interval_text(e.interval, "0", "open");
        table.rows.push_back({method_cell(*m.method),
                              number(e.seconds),
                              {value, true},
                              number(e.baseline),
                              {e.gain.rank == Rank::baseline ? "" : ratio_text(e.gain), true, tone_of(e.gain)},
                              {rank_text(e.gain), false, tone_of(e.gain)}});
    }
    return table;
}

Table slopes_table(const SceneFigures& f)
{
    const auto cell = [](const std::optional<Slope>& s) {
        if (!s) return Cell{"too few points", true};
        return Cell{significant(s->exponent) + " [" + significant(s->interval.low) + " .. " +
                        significant(s->interval.high) + "]",
                    true};
    };
    Table table{"Slopes of log RMSE over the last doublings [95 %]; plain Monte Carlo has -0.5",
                {"method", "over log samples", "over log seconds"},
                {}};
    for (const MethodFigures& m : f.all)
        table.rows.push_back({method_cell(*m.method), cell(m.slope_samples), cell(m.slope_time)});
    return table;
}

Table runs_table(const SceneFigures& f)
{
    Table table{"The runs, medians at their ends",
                {"method", "runs", "failed", "samples per pixel", "wall s", "CPU s", "camera rays", "Mpaths/s",
                 "bounce rays", "shadow rays", "Mrays/s"},
                {}};
    for (const MethodFigures& m : f.all) {
        const auto end = [&](const auto& figure) { return number(at_end(f, *m.method, figure)); };
        // Peers report samples, not rays.
        const auto traced = [&](const auto& figure) { return m.method->peer ? Cell{} : end(figure); };
        table.rows.push_back(
            {method_cell(*m.method),
             {std::to_string(m.runs), true},
             {std::to_string(m.failed), true, m.failed ? Tone::bad : Tone::plain},
             end([](const ErrorPoint& p) { return static_cast<double>(p.spp); }),
             end([](const ErrorPoint& p) { return p.wall_s; }),
             end([](const ErrorPoint& p) { return p.cpu_s; }),
             end([](const ErrorPoint& p) { return static_cast<double>(p.rays_camera); }),
             end([](const ErrorPoint& p) { return static_cast<double>(p.rays_camera) / p.wall_s / 1e6; }),
             traced([](const ErrorPoint& p) { return static_cast<double>(p.rays_bounce); }),
             traced([](const ErrorPoint& p) { return static_cast<double>(p.rays_shadow); }),
             traced([](const ErrorPoint& p) {
                 const uint64_t rays = p.rays_camera + p.rays_bounce + p.rays_shadow;
                 return static_cast<double>(rays) / p.wall_s / 1e6;
             })});
    }
    return table;
}

Table errors_table(const SceneFigures& f)
{
    double first = 0, last = std::numeric_limits<double>::infinity();
    for (const MethodFigures& m : f.all) {
        if (!f.study.on_scene(f.scene.name, m.method->name).not_ranked.empty()) continue;
        first = std::fmax(first, m.first_s), last = std::fmin(last, m.last_s);
    }
    const bool common = first <= last && std::isfinite(last);
    Table table{
        common ? "Errors at equal time, medians" : "Errors at the end of each, as there is no common time; medians",
        {"method", "at s", "relMSE", "relMSE without the worst 0.1 %", "RMSE", "SMAPE", "FLIP"},
        {}};
    for (const MethodFigures& m : f.all) {
        if (m.runs == 0) continue;
        const bool measured = common && m.first_s <= last && last <= m.last_s;
        const ErrorsAt e = errors_at(f.study, f.scene, *m.method, measured ? last : m.last_s);
        table.rows.push_back({method_cell(*m.method), number(e.seconds), number(e.relmse), number(e.relmse_trimmed),
                              number(e.rmse), number(e.smape), number(e.flip)});
    }
    return table;
}

Table levels_table(const SceneFigures& f)
{
    Table table{
        "Exposure and energy of the last pictures: mean radiance over the reference's, and the error of their mean "
        "without noise [95 %]",
        {"method", "pictures", "red", "green", "blue", "systematic relMSE"},
        {}};
    for (const MethodFigures& m : f.all)
        for (const PictureLevel& level : f.study.levels) {
            if (level.scene != f.scene.name || level.method != m.method->name) continue;
            std::vector<Cell> cells{method_cell(*m.method), {std::to_string(level.pictures), true}};
            const auto between = [](const Interval& i, int digits) {
                if (std::isnan(i.low)) return std::string("\ntoo few for an interval");
                return "\n[" + significant(i.low, digits) + " .. " + significant(i.high, digits) + "]";
            };
            for (size_t c = 0; c < 3; ++c)
                cells.push_back({significant(level.ratio[c], 5) + between(level.ratio_interval[c], 5), true});
            const bool told = !std::isnan(level.systematic_relmse);
            cells.push_back(
                {told ? significant(level.systematic_relmse) + between(level.systematic_interval, 3) : "one picture",
                 true, told && level.systematic_interval.low > 0 ? Tone::bad : Tone::plain});
            table.rows.push_back(std::move(cells));
        }
    return table;
}

namespace {

// A refused scene or a missing program is said with its reason.
std::string why_left_out(const Study& study, const StudyScene& scene, const StudyMethod& method)
{
    const std::string& why = study.on_scene(scene.name, method.name).left_out;
    return why.empty() ? "" : "left out: " + why;
}

// The ratio, what it is at, and the verdict.
Cell ratio_cell(const Comparison& c, const std::string& at)
{
    if (c.rank == Rank::not_ranked && std::isnan(c.ratio)) return {rank_text(c), false};
    return {ratio_text(c) + "\n" + at + "\n" + rank_text(c), c.rank != Rank::not_ranked, tone_of(c)};
}

std::string of_scenes(const std::vector<Comparison>& scenes)
{
    const auto counts = [](const Comparison& c) { return c.rank != Rank::not_ranked; };
    return "of " + std::to_string(std::count_if(scenes.begin(), scenes.end(), counts)) + " of " +
           std::to_string(scenes.size()) + " scenes";
}

}  // namespace

Table overview_table(const Study& study)
{
    Table table{"All scenes: " + study.baseline +
                    " against each method. Time of the baseline over that of the method to the least error that "
                    "every run of both reaches, and FLIP at the longest time that both have; above 1 the method is "
                    "better [95 %]",
                {"scene"},
                {}};
    for (const StudyScene& scene : study.scenes) table.rows.push_back({{scene.name}});
    table.rows.push_back({{"geometric mean"}});
    for (const StudyMethod& m : study.methods) {
        if (m.name == study.baseline) continue;
        const std::string name = m.name + (m.biased() ? " (biased)" : "");
        table.head.insert(table.head.end(), {name + ": time to equal error", name + ": FLIP at equal time"});
        const Overview overview = overview_of(study, m);
        std::vector<Comparison> flips;
        for (size_t i = 0; i < study.scenes.size(); ++i) {
            const FlipAtTime& flip = overview.flips[i];
            flips.push_back(flip.ratio);
            if (const std::string why = why_left_out(study, study.scenes[i], m); !why.empty()) {
                table.rows[i].insert(table.rows[i].end(), {Cell{why, false, Tone::bad}, Cell{"left out"}});
                continue;
            }
            table.rows[i].push_back(ratio_cell(overview.times[i], "at relMSE " + round_text(overview.errors[i])));
            table.rows[i].push_back(ratio_cell(flip.ratio, significant(flip.baseline) + " against " +
                                                               significant(flip.method) + " at " +
                                                               significant(flip.seconds) + " s"));
        }
        table.rows.back().push_back(ratio_cell(overview.mean_time, of_scenes(overview.times)));
        table.rows.back().push_back(ratio_cell(overview.mean_flip, of_scenes(flips)));
    }
    return table;
}

Table overview_rows(const Study& study)
{
    const std::string over = ", " + study.baseline + " / method";
    Table table{"", {"scene", "method", "time" + over, "at relMSE", "FLIP" + over, "at s", "verdict on the time"}, {}};
    for (const StudyMethod& m : study.methods) {
        if (m.name == study.baseline) continue;
        const Overview overview = overview_of(study, m);
        const auto add = [&](const std::string& scene, const Comparison& time, double error, const Comparison& flip,
                             double seconds) {
            table.rows.push_back({{scene},
                                  {m.name},
                                  {ratio_text(time), true},
                                  number(error),
                                  {ratio_text(flip), true},
                                  number(seconds),
                                  {rank_text(time)}});
        };
        for (size_t i = 0; i < study.scenes.size(); ++i) {
            const StudyScene& scene = study.scenes[i];
            if (why_left_out(study, scene, m).empty())
                add(scene.name, overview.times[i], overview.errors[i], overview.flips[i].ratio,
                    overview.flips[i].seconds);
            else
                table.rows.push_back({{scene.name}, {m.name}, {}, {}, {}, {}, {"left out"}});
        }
        add("geometric mean", overview.mean_time, no_number, overview.mean_flip, no_number);
    }
    return table;
}

}  // namespace lancer
