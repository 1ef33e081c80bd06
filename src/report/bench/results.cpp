#include "report/bench/results.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "report/page/csv.h"

namespace lancer {
namespace {

using Json = nlohmann::ordered_json;

std::string text_at(const Json& object, const char* key)
{
    const auto it = object.find(key);
    return it != object.end() && it->is_string() ? it->get<std::string>() : "";
}

std::optional<bool> flag_at(const Json& object, const char* key)
{
    const auto it = object.find(key);
    return it != object.end() && it->is_boolean() ? std::optional(it->get<bool>()) : std::nullopt;
}

std::optional<int> count_at(const Json& object, const char* key)
{
    const auto it = object.find(key);
    if (it == object.end() || !it->is_number()) return {};
    const double count = it->get<double>();
    if (!(count >= 0 && count <= std::numeric_limits<int>::max())) return {};
    return static_cast<int>(count);
}

MachineBlock machine_of(const Json& context)
{
    MachineBlock m;
    m.cpu = text_at(context, "cpu"), m.compiler = text_at(context, "compiler"), m.flags = text_at(context, "flags");
    m.embree = text_at(context, "embree"), m.embree_isa = text_at(context, "embree_isa");
    m.tbb = text_at(context, "tbb"), m.date = text_at(context, "date");
    m.executable = text_at(context, "executable"), m.lancer = text_at(context, "lancer");
    m.build_id = text_at(context, "build_id"), m.widest_isa = text_at(context, "embree_widest_isa");
    m.num_cpus = count_at(context, "num_cpus"), m.threads = count_at(context, "threads");
    m.embree_asserts = flag_at(context, "embree_asserts");
    const auto load = context.find("load_avg");
    if (load != context.end() && load->is_array() && !load->empty() && load->front().is_number())
        m.load = load->front().get<double>();
    if (const auto end = context.find("load_at_end"); end != context.end() && end->is_number())
        m.load_at_end = end->get<double>();
    return m;
}

// Takes a member of an object that is a number, a text, or yes or no.
void take_field(const std::string& key, const Json& value, BenchFields& fields)
{
    if (value.is_string())
        fields.texts.emplace_back(key, value.get<std::string>());
    else if (value.is_boolean())
        fields.texts.emplace_back(key, value.get<bool>() ? "yes" : "no");
    else if (value.is_number())
        fields.numbers.emplace_back(key, value.get<double>());
}

Json machine_json(const MachineBlock& m)
{
    Json json = Json::object();
    const auto tell = [&](const char* key, const auto& value) {
        if (value) json[key] = *value;
    };
    json["date"] = m.date, json["cpu"] = m.cpu;
    tell("num_cpus", m.num_cpus), tell("threads", m.threads);
    if (m.load) json["load_avg"] = Json::array({*m.load});
    tell("load_at_end", m.load_at_end);
    json["compiler"] = m.compiler, json["flags"] = m.flags, json["embree"] = m.embree;
    json["embree_isa"] = m.embree_isa, json["embree_widest_isa"] = m.widest_isa;
    tell("embree_asserts", m.embree_asserts);
    json["tbb"] = m.tbb, json["executable"] = m.executable, json["lancer"] = m.lancer, json["build_id"] = m.build_id;
    return json;
}

void put_fields(const BenchFields& fields, Json& json)
{
    constexpr double most_whole = 0x1p53;
    for (const auto& [key, text] : fields.texts) json[key] = text;
    for (const auto& [key, number] : fields.numbers) {
        if (number == std::trunc(number) && std::abs(number) < most_whole)
            json[key] = static_cast<int64_t>(number);
        else
            json[key] = number;
    }
}

// A file name need not be UTF-8; the text must be.
std::string text_of(const Json& json) { return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }

BenchRow row_of(const Json& json)
{
    BenchRow row;
    static constexpr std::array<std::pair<const char*, std::string BenchRow::*>, 6> named{
        {{"name", &BenchRow::name},
         {"family", &BenchRow::family},
         {"mesh", &BenchRow::mesh},
         {"accel", &BenchRow::accel},
         {"rays", &BenchRow::rays},
         {"way", &BenchRow::way}}};
    for (const auto& [key, value] : json.items()) {
        const auto member =
            std::find_if(named.begin(), named.end(), [&, k = key](const auto& n) { return k == n.first; });
        if (value.is_string() && member != named.end())
            row.*member->second = value.get<std::string>();
        else
            take_field(key, value, row);
    }
    return row;
}

}  // namespace

std::optional<double> BenchFields::number(const std::string& key) const
{
    for (const auto& [name_of, value] : numbers)
        if (name_of == key) return value;
    return {};
}

std::string BenchFields::text(const std::string& key) const
{
    for (const auto& [name_of, value] : texts)
        if (name_of == key) return value;
    return "";
}

Ranged BenchRow::mega_per_second() const
{
    Ranged r;
    if (const auto rate = number("items_per_second")) r.value = *rate / 1e6;
    // Of times in nanoseconds: the longest is the lowest speed.
    if (const auto least = number("min"), most = number("max"); least && most)
        r.low = 1e3 / *most, r.high = 1e3 / *least;
    return r;
}

std::optional<Ratio> BenchRow::speed_ratio() const
{
    const auto value = number("ratio"), low = number("ratio_min"), high = number("ratio_max");
    if (!value) return {};
    return Ratio{*value, low.value_or(*value), high.value_or(*value)};
}

BenchFile read_bench(const std::string& name, const std::string& json)
{
    const auto refuse = [&](const std::string& why) { return Error(ErrorKind::invalid_input, {name, 0, 0}, why); };
    const Json all = Json::parse(json, nullptr, false);
    if (all.is_discarded()) throw refuse("not JSON");
    if (!all.is_object() || !all.contains("context") || !all["context"].is_object() || !all.contains("benchmarks") ||
        !all["benchmarks"].is_array())
        throw refuse("no \"context\" or no \"benchmarks\": not a file of a bench program");
    BenchFile file{name, machine_of(all["context"]), {}, {}, json};
    for (const auto& [key, value] : all["context"].items()) take_field(key, value, file.context);
    for (const Json& row : all["benchmarks"]) {
        if (!row.is_object()) throw refuse("a row of \"benchmarks\" that is not an object");
        file.rows.push_back(row_of(row));
        if (file.rows.back().name.empty() || file.rows.back().family.empty())
            throw refuse("a row without \"name\" or \"family\"");
    }
    if (file.rows.empty()) throw refuse("no row");
    return file;
}

std::string context_json(const MachineBlock& machine) { return text_of(machine_json(machine)); }

std::string to_json(const MachineBlock& machine, const BenchFields& context, const std::vector<BenchRow>& rows)
{
    Json all{{"context", machine_json(machine)}, {"benchmarks", Json::array()}};
    put_fields(context, all["context"]);
    for (const BenchRow& row : rows) {
        Json json{{"name", row.name},
                  {"run_name", row.name},
                  {"run_type", "aggregate"},
                  {"aggregate_name", "median"},
                  {"family", row.family}};
        for (const auto& [key, member] : {std::pair{"mesh", &BenchRow::mesh}, std::pair{"accel", &BenchRow::accel},
                                          std::pair{"rays", &BenchRow::rays}, std::pair{"way", &BenchRow::way}})
            if (!(row.*member).empty()) json[key] = row.*member;
        put_fields(row, json);
        all["benchmarks"].push_back(std::move(json));
    }
    return text_of(all);
}

std::string named_csv(const std::vector<NamedFields>& rows)
{
    CsvFields columns;
    for (const NamedFields& row : rows)
        for (const auto& [name, value] : row)
            if (std::find(columns.begin(), columns.end(), name) == columns.end()) columns.push_back(name);
    std::string csv = csv_row(columns);
    for (const NamedFields& row : rows) {
        CsvFields fields(columns.size());
        for (const auto& [name, value] : row)
            fields[static_cast<size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin())] = value;
        csv += csv_row(fields);
    }
    return csv;
}

BenchRows rows_of(const std::vector<BenchFile>& files, const std::string& family)
{
    BenchRows rows;
    for (const BenchFile& file : files)
        for (const BenchRow& row : file.rows)
            if (family.empty() || row.family == family) rows.push_back(&row);
    return rows;
}

std::vector<std::string> distinct(const BenchRows& rows, std::string BenchRow::*member)
{
    std::vector<std::string> values;
    for (const BenchRow* row : rows) {
        const std::string& value = row->*member;
        if (!value.empty() && std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
    }
    return values;
}

BenchRows where(const BenchRows& rows, std::string BenchRow::*member, const std::string& value)
{
    BenchRows kept;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(kept),
                 [&](const BenchRow* row) { return row->*member == value; });
    return kept;
}

}  // namespace lancer
