// Rows S of the stability matrix: every scene of the folder scenes, drawn by the program with so many samples that
// there are a billion in all. None may be dropped.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/run_program.h"
#include "stability/row.h"

namespace lancer::stability {
namespace {

namespace fs = std::filesystem;

constexpr double samples_of_all = 1e9, samples_of_each_picture = 2e6;
constexpr uint32_t width = 480, height = 270;

struct SceneFile {
    std::string path;
    double samples;
};

std::vector<SceneFile> scene_files()
{
    std::vector<SceneFile> files;
    for (const auto& entry : fs::recursive_directory_iterator(LANCER_SOURCE_DIR "/scenes"))
        if (entry.path().extension() == ".toml") files.push_back({entry.path(), samples_of_each_picture});
    std::sort(files.begin(), files.end(), [](const SceneFile& a, const SceneFile& b) { return a.path < b.path; });
    // The pictures in folders of their own are many and alike.
    const auto is_main = [](const SceneFile& f) { return fs::path(f.path).parent_path().filename() == "scenes"; };
    const auto main_ones = static_cast<double>(std::count_if(files.begin(), files.end(), is_main));
    for (SceneFile& f : files)
        if (is_main(f)) f.samples = samples_of_all / main_ones;
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
    out.samples = counted.at("count").get<uint64_t>() - counted.at("background_only").get<uint64_t>();
    out.dropped = counted.at("dropped").at("count").get<uint64_t>();
    out.measures.push_back(told("samples traced", static_cast<double>(out.samples)));
    out.measures.push_back(exactly("samples dropped", static_cast<double>(out.dropped), 0));
    return out;
}

}  // namespace

std::vector<Row> shipped_rows()
{
    std::vector<Row> rows;
    for (const SceneFile& file : scene_files())
        rows.push_back({"S" + std::to_string(rows.size() + 1),
                        fs::relative(file.path, LANCER_SOURCE_DIR "/scenes").string() + ", a part of a billion samples",
                        "policy", Tier::B, false, [=](const Setup&) { return draw(file.path, file.samples); }});
    return rows;
}

}  // namespace lancer::stability
