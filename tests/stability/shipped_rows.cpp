// Rows S of the stability matrix: every scene of the folder scenes, drawn by the program with as many samples as make
// 1e9 of all of them together. None may be dropped.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/run_program.h"
#include "stability/row.h"

namespace lancer::stability {
namespace {

namespace fs = std::filesystem;

constexpr double samples_of_all = 1e9;
constexpr uint32_t width = 480, height = 270;

std::vector<std::string> scene_files()
{
    std::vector<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(LANCER_SOURCE_DIR "/scenes"))
        if (entry.path().extension() == ".toml") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

Outcome draw(const std::string& file, double samples)
{
    const TempFolder folder;
    const auto spp = static_cast<uint64_t>(std::ceil(samples / (width * height)));
    const Said said =
        Program(folder, {"render", file, "-q", "--size", std::to_string(width) + "x" + std::to_string(height), "-s",
                         std::to_string(spp), "-o", "a.exr", "--stats", "a.json"})
            .wait();
    Outcome out;
    out.measures.push_back(exactly("exit code", said.code, 0));
    if (said.code != 0) return out;
    const auto counted = nlohmann::json::parse(read_bytes(folder.file("a.json"))).at("samples");
    // Pixels of open sky are the sky: no ray of theirs is traced.
    out.samples = counted.at("count").get<uint64_t>() - counted.at("of_open_sky").get<uint64_t>();
    out.dropped = counted.at("dropped").at("count").get<uint64_t>();
    out.measures.push_back(told("samples traced", static_cast<double>(out.samples)));
    out.measures.push_back(exactly("samples dropped", static_cast<double>(out.dropped), 0));
    return out;
}

}  // namespace

std::vector<Row> shipped_rows()
{
    std::vector<Row> rows;
    const std::vector<std::string> files = scene_files();
    for (const std::string& file : files)
        rows.push_back(
            {"S" + std::to_string(rows.size() + 1),
             fs::relative(file, LANCER_SOURCE_DIR "/scenes").string() + ", " + "its share of a billion samples",
             "policy", Tier::B, false,
             [=, n = files.size()](const Setup&) { return draw(file, samples_of_all / static_cast<double>(n)); }});
    return rows;
}

}  // namespace lancer::stability
