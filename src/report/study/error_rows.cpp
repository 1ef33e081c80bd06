#include "report/study/error_rows.h"

#include <array>
#include <cmath>

#include "report/metrics/flip.h"
#include "report/page/csv.h"

namespace lancer {
namespace {

constexpr std::array reals{&ErrorRow::spp, &ErrorRow::wall_s, &ErrorRow::cpu_s};
constexpr std::array counts{&ErrorRow::camera_rays, &ErrorRow::bounce_rays, &ErrorRow::shadow_rays};
constexpr std::array errors{
    &ErrorRow::rmse,          &ErrorRow::relmse, &ErrorRow::relmse_trimmed,  &ErrorRow::relmse_unbiased,
    &ErrorRow::smape,         &ErrorRow::flip,   &ErrorRow::estimated_error, &ErrorRow::estimated_low,
    &ErrorRow::estimated_high};

// In the order of the three lists.
const CsvFields error_columns{"spp",         "wall_s", "cpu_s",           "camera_rays",    "bounce_rays",
                              "shadow_rays", "rmse",   "relmse",          "relmse_trimmed", "relmse_unbiased",
                              "smape",       "flip",   "estimated_error", "estimated_low",  "estimated_high"};

}  // namespace

std::string error_rows_head() { return csv_row(error_columns); }

std::string to_csv(const ErrorRow& row)
{
    CsvFields fields;
    for (const auto member : reals) fields.push_back(csv_number(row.*member));
    for (const auto member : counts) fields.push_back(csv_number(row.*member));
    for (const auto member : errors) fields.push_back(csv_number(row.*member));
    return csv_row(fields);
}

std::vector<ErrorRow> read_error_rows(const std::string& name, const std::string& csv)
{
    CsvReader reader(name, csv);
    CsvFields fields;
    if (!reader.next(fields) || fields != error_columns) throw reader.wrong("not the columns of a log of errors");
    std::vector<ErrorRow> rows;
    while (reader.next(fields)) {
        if (fields.size() != error_columns.size())
            throw reader.wrong(std::to_string(fields.size()) + " fields instead of " +
                               std::to_string(error_columns.size()));
        ErrorRow& row = rows.emplace_back();
        size_t i = 0;
        const auto real = [&] { return reader.real(error_columns[i], fields[i]); };
        for (const auto member : reals) row.*member = real(), ++i;
        for (const auto member : counts) row.*member = reader.count(error_columns[i], fields[i]), ++i;
        for (const auto member : errors) row.*member = real(), ++i;
    }
    return rows;
}

Metrics measure_errors(ErrorRow& row, const Image& picture, const Image& reference, const Image* second, bool with_flip)
{
    const Metrics m = compare(picture, reference);
    row.rmse = m.rmse, row.relmse = m.relmse, row.relmse_trimmed = m.relmse_trimmed, row.smape = m.smape;
    if (second) row.relmse_unbiased = unbiased_squared_error(picture, reference, *second);
    if (with_flip) row.flip = flip_hdr(picture, reference).mean;
    return m;
}

ErrorPoint point_of(const ErrorRow& row)
{
    return {.spp = static_cast<uint32_t>(row.spp),
            .wall_s = row.wall_s,
            .cpu_s = row.cpu_s,
            .rays_camera = row.camera_rays,
            .rays_bounce = row.bounce_rays,
            .rays_shadow = row.shadow_rays,
            .rmse = row.rmse,
            .relmse = std::isnan(row.relmse_unbiased) ? row.relmse : row.relmse_unbiased,
            .relmse_trimmed = row.relmse_trimmed,
            .smape = row.smape,
            .flip = row.flip};
}

}  // namespace lancer
