#include "io/study_file.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "core/names.h"
#include "io/input_text.h"
#include "io/toml_file.h"
#include "io/toml_reader.h"

namespace lancer {
namespace {

// Words between blanks.
std::vector<std::string> words_of(const std::string& text)
{
    std::istringstream stream(text);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

// A name that is part of a file's name.
std::string plain_name(const TomlTable& table)
{
    if (!table.require("name")) return {};
    const std::string name = table.text("name").value_or("");
    constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
    if (name.find_first_not_of(allowed) != std::string::npos) table.error("name", " may have letters, digits, - and _");
    return name;
}

template <class T>
void refuse_doubles(const TomlTable& root, std::string_view key, const std::vector<T>& all)
{
    for (size_t i = 0; i < all.size(); ++i)
        for (size_t j = 0; j < i; ++j)
            if (all[i].name == all[j].name && !all[i].name.empty())
                root.error(root.tables(key)[i].where("name"), "two are named " + in_quotes(all[i].name));
    if (all.empty()) root.error(root.where(), "there is no [[" + std::string(key) + "]]");
}

// Without a file where it is optional and not there.
StudyPlan::Scene read_scene(const TomlTable& table, const std::filesystem::path& folder, Diagnostics& diagnostics)
{
    table.allow({"name", "description", "file", "options", "reference_spp", "optional"});
    StudyPlan::Scene scene;
    scene.name = plain_name(table);
    scene.description = table.text("description").value_or("");
    scene.options = words_of(table.text("options").value_or(""));
    if (const auto n = table.integer("reference_spp", 16, 1 << 24)) scene.reference_spp = static_cast<uint32_t>(*n);
    if (!table.require("file")) return scene;
    scene.file = (folder / table.text("file").value_or("")).lexically_normal();
    if (std::filesystem::exists(scene.file)) return scene;
    const std::string missing = "no such file: " + in_quotes(scene.file);
    if (table.boolean("optional").value_or(false)) {
        diagnostics.warning(table.where("file"), missing + ": the scene is left out");
        scene.file.clear();
        return scene;
    }
    table.error(table.where("file"), missing, ErrorKind::missing_input);
    return scene;
}

StudyPlan::Method read_method(const TomlTable& table)
{
    table.allow({"name", "description", "options", "peer", "throughput_only", "own_reference_spp", "time"});
    StudyPlan::Method method;
    method.name = plain_name(table);
    method.description = table.text("description").value_or("");
    method.options = words_of(table.text("options").value_or(""));
    method.peer = table.text("peer").value_or("");
    if (table.has("peer") && table.has("options"))
        table.error("options", " are of lancer, and a peer is another program: give one of them");
    for (const char* key : {"throughput_only", "own_reference_spp"})
        if (table.has(key) && !table.has("peer")) table.error(key, " is of peers alone");
    method.throughput_only = table.boolean("throughput_only").value_or(false);
    if (const auto n = table.integer("own_reference_spp", 16, 1 << 24))
        method.own_reference_spp = static_cast<uint32_t>(*n);
    method.time = table.number("time", above_zero);
    return method;
}

}  // namespace

StudyPlan load_study_file(const std::string& path, Diagnostics& diagnostics)
{
    StudyPlan plan;
    const std::optional<TomlValue> tree = parse_toml(read_input_text(path), path, diagnostics);
    if (!tree) return plan;
    TomlProblems problems({path});
    const TomlTable root(*tree, "", problems);
    root.allow({"version", "title", "baseline", "seeds", "time", "spp", "peers", "peer_timeout", "scene", "method"});
    if (root.require("version")) root.integer("version", 1, 1);
    plan.title = root.text("title").value_or(std::filesystem::path(path).stem());
    if (const auto n = root.integer("seeds", 1, 1000)) plan.seeds = static_cast<uint32_t>(*n);
    plan.time = root.number("time", above_zero);
    if (const auto n = root.integer("spp", 1, 1 << 28)) plan.spp = static_cast<uint32_t>(*n);
    if (!plan.time && !plan.spp) root.error(root.where(), "'time' (seconds of a run) or 'spp' is needed");
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    if (const auto peers = root.text("peers")) plan.peers = (folder / *peers).lexically_normal();
    plan.peer_timeout = root.number("peer_timeout", above_zero).value_or(plan.peer_timeout);
    for (const TomlTable& table : root.tables("scene")) plan.scenes.push_back(read_scene(table, folder, diagnostics));
    for (const TomlTable& table : root.tables("method")) {
        StudyPlan::Method& method = plan.methods.emplace_back(read_method(table));
        if (!method.time) method.time = plan.time;
        if (table.has("peer") && plan.peers.empty())
            table.error("peer", " needs 'peers' at the top level: the folder of the script that starts it");
    }
    refuse_doubles(root, "scene", plan.scenes);
    refuse_doubles(root, "method", plan.methods);
    if (std::erase_if(plan.scenes, [](const StudyPlan::Scene& s) { return s.file.empty(); }) > 0 && plan.scenes.empty())
        root.error(root.where(), "none of its scenes is there");
    plan.baseline = root.text("baseline").value_or(plan.methods.empty() ? "" : plan.methods.front().name);
    if (std::none_of(plan.methods.begin(), plan.methods.end(), [&](const auto& m) { return m.name == plan.baseline; }))
        root.error(root.where("baseline"), "no [[method]] is named " + in_quotes(plan.baseline));
    problems.report(diagnostics);
    return plan;
}

}  // namespace lancer
