#include "report/study_csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "report/study_check.h"

namespace lancer {
namespace {

using Fields = std::vector<std::string>;

constexpr std::array columns{"scene",       "method",      "seed",        "spp",    "wall_s", "cpu_s",
                             "rays_camera", "rays_bounce", "rays_shadow", "rmse",   "relmse", "relmse_trimmed",
                             "smape",       "flip",        "failed",      "problem"};

template <class T>
std::string text_of(T x)
{
    std::array<char, 40> buffer;  // a double takes 24 letters
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x);
    return {buffer.data(), end.ptr};
}

std::string figure(double x) { return std::isnan(x) ? "" : text_of(x); }

std::string quoted(const std::string& text)
{
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

std::string row_of(const Fields& fields)
{
    std::string row;
    for (size_t i = 0; i < fields.size(); ++i) row += (i ? "," : "") + quoted(fields[i]);
    return row + "\n";
}

// Fields of the rows of a text, with the line on which each row begins.
class Rows {
public:
    Rows(const std::string& name, const std::string& text) : name_(name), text_(text) {}

    bool next(Fields& fields)
    {
        line_ = next_line_;
        if (at_ >= text_.size()) return false;
        fields.assign(1, "");
        while (at_ < text_.size()) {
            const char c = text_[at_++];
            if (c == '"') {
                quoted_part(fields.back());
            } else if (c == ',') {
                fields.emplace_back();
            } else if (c == '\n') {
                ++next_line_;
                break;
            } else if (c != '\r') {
                fields.back() += c;
            }
        }
        return true;
    }
    Error wrong(const std::string& why) const { return {ErrorKind::invalid_input, {name_, line_, 0}, why}; }

private:
    void quoted_part(std::string& field)
    {
        for (; at_ < text_.size(); ++at_) {
            if (text_[at_] == '"' && (at_ + 1 == text_.size() || text_[at_ + 1] != '"')) {
                ++at_;
                return;
            }
            if (text_[at_] == '"') ++at_;
            if (text_[at_] == '\n') ++next_line_;
            field += text_[at_];
        }
        throw wrong("a quote that is not closed");
    }

    const std::string& name_;
    const std::string& text_;
    size_t at_ = 0;
    uint32_t line_ = 1, next_line_ = 1;
};

template <class T>
T number_of(const Rows& rows, const std::string& column, const std::string& text)
{
    T x{};
    const auto end = std::from_chars(text.data(), text.data() + text.size(), x);
    if (text.empty() || end.ec != std::errc{} || end.ptr != text.data() + text.size())
        throw rows.wrong("'" + text + "' in column " + column + " is no such number");
    return x;
}

ErrorPoint point_of(const Rows& rows, const Fields& f)
{
    ErrorPoint p;
    const auto count = [&](size_t i, auto& x) { x = number_of<std::decay_t<decltype(x)>>(rows, columns[i], f[i]); };
    const auto real = [&](size_t i, double& x) {
        x = f[i].empty() ? std::numeric_limits<double>::quiet_NaN() : number_of<double>(rows, columns[i], f[i]);
    };
    count(3, p.spp), real(4, p.wall_s), real(5, p.cpu_s);
    count(6, p.rays_camera), count(7, p.rays_bounce), count(8, p.rays_shadow);
    real(9, p.rmse), real(10, p.relmse), real(11, p.relmse_trimmed), real(12, p.smape), real(13, p.flip);
    return p;
}

}  // namespace

std::string to_csv(const std::vector<StudyRun>& runs)
{
    std::string csv = row_of({columns.begin(), columns.end()});
    for (const StudyRun& run : runs) {
        const std::string seed = text_of(run.seed), failed = run.failed ? "yes" : "no";
        if (run.points.empty())
            csv +=
                row_of({run.scene, run.method, seed, "", "", "", "", "", "", "", "", "", "", "", failed, run.problem});
        for (const ErrorPoint& p : run.points)
            csv += row_of({run.scene, run.method, seed, text_of(p.spp), figure(p.wall_s), figure(p.cpu_s),
                           text_of(p.rays_camera), text_of(p.rays_bounce), text_of(p.rays_shadow), figure(p.rmse),
                           figure(p.relmse), figure(p.relmse_trimmed), figure(p.smape), figure(p.flip), failed,
                           run.problem});
    }
    return csv;
}

std::vector<StudyRun> read_study_csv(const std::string& name, const std::string& csv)
{
    Rows rows(name, csv);
    Fields f;
    if (!rows.next(f) || !std::equal(f.begin(), f.end(), columns.begin(), columns.end()))
        throw rows.wrong("not the columns of a study: " + row_of({columns.begin(), columns.end()}).substr(0, 40) +
                         "...");
    std::vector<StudyRun> runs;
    while (rows.next(f)) {
        if (f.size() == 1 && f[0].empty()) continue;
        if (f.size() != columns.size())
            throw rows.wrong(std::to_string(f.size()) + " fields instead of " + std::to_string(columns.size()));
        if (f[14] != "yes" && f[14] != "no") throw rows.wrong("'" + f[14] + "' in column failed is neither yes nor no");
        const auto seed = number_of<uint64_t>(rows, columns[2], f[2]);
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
