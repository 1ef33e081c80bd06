#include "report/study/csv.h"

#include <algorithm>
#include <array>
#include <limits>

#include "report/page/csv.h"
#include "report/study/check.h"

namespace lancer {
namespace {

constexpr std::array study_columns{"scene",       "method",      "seed",        "spp",    "wall_s", "cpu_s",
                                   "rays_camera", "rays_bounce", "rays_shadow", "rmse",   "relmse", "relmse_trimmed",
                                   "smape",       "flip",        "failed",      "problem"};

ErrorPoint point_of(const CsvReader& rows, const CsvFields& f)
{
    ErrorPoint p;
    const auto count = [&](size_t i) { return rows.count(study_columns[i], f[i]); };
    const auto real = [&](size_t i) { return rows.real(study_columns[i], f[i]); };
    if (count(3) > std::numeric_limits<uint32_t>::max())
        throw rows.wrong("'" + f[3] + "' in column " + study_columns[3] + " is too large");
    p.spp = static_cast<uint32_t>(count(3)), p.wall_s = real(4), p.cpu_s = real(5);
    p.rays_camera = count(6), p.rays_bounce = count(7), p.rays_shadow = count(8);
    p.rmse = real(9), p.relmse = real(10), p.relmse_trimmed = real(11), p.smape = real(12), p.flip = real(13);
    return p;
}

}  // namespace

std::string to_csv(const std::vector<StudyRun>& runs)
{
    std::string csv = csv_row({study_columns.begin(), study_columns.end()});
    for (const StudyRun& run : runs) {
        const std::string seed = csv_number(run.seed), failed = run.failed ? "yes" : "no";
        if (run.points.empty())
            csv +=
                csv_row({run.scene, run.method, seed, "", "", "", "", "", "", "", "", "", "", "", failed, run.problem});
        for (const ErrorPoint& p : run.points)
            csv +=
                csv_row({run.scene, run.method, seed, csv_number(uint64_t{p.spp}), csv_number(p.wall_s),
                         csv_number(p.cpu_s), csv_number(p.rays_camera), csv_number(p.rays_bounce),
                         csv_number(p.rays_shadow), csv_number(p.rmse), csv_number(p.relmse),
                         csv_number(p.relmse_trimmed), csv_number(p.smape), csv_number(p.flip), failed, run.problem});
    }
    return csv;
}

std::vector<StudyRun> read_study_csv(const std::string& name, const std::string& csv)
{
    CsvReader rows(name, csv);
    CsvFields f;
    if (!rows.next(f) || !std::equal(f.begin(), f.end(), study_columns.begin(), study_columns.end()))
        throw rows.wrong("not the columns of a study: " +
                         csv_row({study_columns.begin(), study_columns.end()}).substr(0, 40) + "...");
    std::vector<StudyRun> runs;
    while (rows.next(f)) {
        if (f.size() == 1 && f[0].empty()) continue;
        if (f.size() != study_columns.size())
            throw rows.wrong(std::to_string(f.size()) + " fields instead of " + std::to_string(study_columns.size()));
        if (f[14] != "yes" && f[14] != "no") throw rows.wrong("'" + f[14] + "' in column failed is neither yes nor no");
        const auto seed = rows.count(study_columns[2], f[2]);
        auto run = std::find_if(runs.begin(), runs.end(), [&](const StudyRun& r) {
            return r.scene == f[0] && r.method == f[1] && r.seed == seed;
        });
        if (run == runs.end()) run = runs.insert(run, {f[0], f[1], seed, {}, f[14] == "yes", f[15]});
        const bool no_point = std::all_of(f.begin() + 3, f.begin() + 14, [](const auto& t) { return t.empty(); });
        if (!no_point) run->points.push_back(point_of(rows, f));
    }
    for (const StudyRun& run : runs) check_points(name, run);
    return runs;
}

}  // namespace lancer
