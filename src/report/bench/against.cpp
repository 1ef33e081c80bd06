#include "report/bench/against.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace lancer {
namespace {

bool has_interval(const Ranged& r) { return std::isfinite(r.low) && std::isfinite(r.high); }

std::string kinds_of(const BenchRun& run)
{
    std::string text;
    for (const auto& [kind, hash] : run.rays) text += (text.empty() ? "" : ", ") + kind;
    return text;
}

AgainstCell cell_of(const BenchFigure& now, const BenchFigure& before)
{
    AgainstCell cell{&now, *before.ratio, {}};
    const Ranged &a = *now.ratio, &b = *before.ratio;
    cell.quotient.value = a.value / b.value;
    cell.absolute = before.time_ns.value / now.time_ns.value;
    cell.judged = has_interval(a) && has_interval(b);
    if (!cell.judged) return cell;
    const Ratio widest = ratio({a.value, a.low, a.high}, {b.value, b.low, b.high});
    cell.quotient.low = widest.low, cell.quotient.high = widest.high;
    cell.differs = a.low > b.high || b.low > a.high;
    return cell;
}

void remark_answers(const BenchFigure& now, const BenchFigure& before, const std::string& mesh,
                    std::vector<std::string>& remarks)
{
    for (const char* what : {"wrong_per_million", "missed_per_million", "differing_pixels"}) {
        const auto a = now.counter(what), b = before.counter(what);
        if (a && b && *a != *b)
            remarks.push_back(now.name(mesh) + ": " + what + " " + std::to_string(*a) + ", before " +
                              std::to_string(*b));
    }
}

}  // namespace

size_t BenchAgainst::differing() const
{
    return static_cast<size_t>(std::count_if(cells.begin(), cells.end(), [](const auto& c) { return c.differs; }));
}

size_t BenchAgainst::close() const
{
    return static_cast<size_t>(std::count_if(cells.begin(), cells.end(), [](const auto& c) { return c.is_close(); }));
}

void annotate(BenchRun& now, const BenchAgainst& against)
{
    for (const AgainstCell& cell : against.cells) {
        auto& counters = now.figures[static_cast<size_t>(cell.now - now.figures.data())].counters;
        counters.emplace_back("against", cell.quotient.value);
        if (!cell.judged) continue;
        counters.emplace_back("against_low", cell.quotient.low);
        counters.emplace_back("against_high", cell.quotient.high);
        counters.emplace_back("against_differs", cell.differs ? 1 : 0);
    }
}

BenchAgainst compare(const BenchRun& now, const BenchRun& before, const std::string& earlier)
{
    const auto refuse = [&](const std::string& why) { return Error(ErrorKind::invalid_input, {earlier, 0, 0}, why); };
    if (now.mesh_hash != before.mesh_hash)
        throw refuse("is of another mesh: '" + before.mesh + "' with " + std::to_string(before.triangles) +
                     " triangles, not '" + now.mesh + "' with " + std::to_string(now.triangles));
    if (kinds_of(now) != kinds_of(before))
        throw refuse("is of other kinds of rays: " + kinds_of(before) + "; these are " + kinds_of(now));
    BenchAgainst against{earlier, {}, {}};
    std::vector<std::string>& remarks = against.remarks;
    if (now.rays != before.rays) remarks.push_back("the rays are not the same: the view or the version differs");
    for (const std::string& reason : not_comparable(before.machine, now.machine)) remarks.push_back(reason);
    for (const BenchFigure& figure : now.figures) {
        const BenchFigure* other = before.find(figure, figure.accel);
        if (!other) continue;
        if (figure.ratio && other->ratio) against.cells.push_back(cell_of(figure, *other));
        remark_answers(figure, *other, now.mesh, remarks);
    }
    return against;
}

}  // namespace lancer
