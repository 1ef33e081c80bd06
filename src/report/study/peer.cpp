#include "report/study/peer.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.h"

namespace lancer {
namespace {

// What of_json makes of a text; any fault of the text is the error of the one who wrote it.
template <class Function>
auto read_json(const std::string& name, const std::string& text, const Function& of_json)
{
    try {
        return of_json(nlohmann::json::parse(text));
    } catch (const nlohmann::json::exception&) {
        throw Error(ErrorKind::failed, {}, name + " printed invalid peer JSON: " + text.substr(0, 200));
    }
}

PeerRecord record_of(const nlohmann::json& json)
{
    PeerRecord record;
    // What is no number of samples becomes 0, for which nobody asks.
    const double spp = json.at("spp").get<double>();
    if (spp >= 0 && spp <= std::numeric_limits<uint32_t>::max()) record.spp = static_cast<uint32_t>(spp);
    record.render_wall_s = json.at("render_wall_s").get<double>();
    if (!json.at("render_cpu_s").is_null()) record.render_cpu_s = json.at("render_cpu_s").get<double>();
    record.biases = json.at("biases").get<std::vector<std::string>>();
    return record;
}

constexpr uint32_t most_samples = 1u << 28;  // of lancer render

uint32_t square_below(double x)
{
    auto side = static_cast<uint32_t>(std::sqrt(x));
    return std::max(side * side, 1u);
}

}  // namespace

PeerAbout read_peer_about(const std::string& name, const std::string& json)
{
    return read_json(name, json, [](const nlohmann::json& j) {
        return PeerAbout{j.at("version").get<std::string>(), j.at("seeds").get<bool>(), j.at("squares").get<bool>()};
    });
}

std::vector<PeerRecord> read_peer_records(const std::string& name, const std::string& lines,
                                          const std::vector<uint32_t>& spps)
{
    std::vector<PeerRecord> records;
    std::istringstream stream(lines);
    for (std::string line; std::getline(stream, line);)
        if (!line.empty()) records.push_back(read_json(name, line, record_of));
    if (records.size() != spps.size())
        throw Error(ErrorKind::failed, {},
                    name + " told of " + std::to_string(records.size()) + " pictures and was asked for " +
                        std::to_string(spps.size()));
    for (size_t i = 0; i < spps.size(); ++i) {
        const PeerRecord& r = records[i];
        if (r.spp != spps[i])
            throw Error(
                ErrorKind::failed, {},
                name + " told of " + std::to_string(r.spp) + " samples and was asked for " + std::to_string(spps[i]));
        if (!(r.render_wall_s >= 0) || std::isinf(r.render_wall_s) || r.render_cpu_s < 0)
            throw Error(ErrorKind::failed, {}, name + " reported invalid seconds");
    }
    return records;
}

std::vector<uint32_t> peer_samples(double seconds_per_sample, std::optional<double> time, std::optional<uint32_t> most,
                                   bool squares)
{
    double last = most ? *most : most_samples;
    if (time) last = std::clamp(*time / seconds_per_sample, 1.0, last);
    std::vector<uint32_t> samples;
    for (uint32_t n = static_cast<uint32_t>(last); n > 0; n /= 4) samples.push_back(squares ? square_below(n) : n);
    std::reverse(samples.begin(), samples.end());
    return samples;
}

}  // namespace lancer
