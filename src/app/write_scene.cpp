#include "app/write_scene.h"

#include <algorithm>
#include <filesystem>

#include "io/file_name.h"
#include "io/input_text.h"
#include "io/scene/definition.h"
#include "io/scene/scene_file.h"
#include "io/toml_edit.h"
#include "io/toml_file.h"
#include "io/toml_write.h"
#include "scene/build/overrides.h"
#include "scene/description/render_options.h"

namespace lancer {
namespace fs = std::filesystem;

namespace {

using Entries = TomlValue::Table;

TomlValue& entry(Entries& table, const std::string& key, TomlValue usual)
{
    if (TomlValue* const found = value_at(table, key)) return *found;
    table.push_back({.key = key, .value = std::move(usual)});
    return table.back().value;
}

Entries& table_at(Entries& table, const std::string& key)
{
    return std::get<Entries>(entry(table, key, {.data = Entries{}}).data);
}

void set(Entries& table, const std::string& key, TomlValue value) { entry(table, key, {}) = std::move(value); }

void drop(Entries& table, const std::string& key)
{
    table.erase(std::remove_if(table.begin(), table.end(), [&](const TomlEntry& e) { return e.key == key; }),
                table.end());
}

TomlValue to_value(Vec3d v) { return {.data = TomlValue::Array{{.data = v.x}, {.data = v.y}, {.data = v.z}}}; }

// Adds to tables, and puts further elements behind those of lists.
void merge(Entries& into, const Entries& more)
{
    for (const TomlEntry& e : more) {
        if (const auto* table = std::get_if<Entries>(&e.value.data)) {
            merge(table_at(into, e.key), *table);
        } else if (const auto* array = std::get_if<TomlValue::Array>(&e.value.data);
                   array && !array->empty() && std::holds_alternative<Entries>(array->front().data)) {
            auto& list = std::get<TomlValue::Array>(entry(into, e.key, {.data = TomlValue::Array{}}).data);
            list.insert(list.end(), array->begin(), array->end());
        } else {
            set(into, e.key, e.value);
        }
    }
}

// The camera that was rendered becomes [camera]. Others stay, with the values that they have inherited.
void set_camera(Entries& root, const std::string& chosen, const CameraDescription& camera)
{
    Entries& table = table_at(root, "camera");
    Entries own;
    for (const TomlEntry& e : table) {
        const auto* named = std::get_if<Entries>(&e.value.data);
        if (!named) set(own, e.key, e.value);
    }
    for (const TomlEntry& e : Entries(table))
        if (const auto* named = std::get_if<Entries>(&e.value.data)) {
            Entries whole = own;
            merge(whole, *named);
            if (e.key == chosen) {
                for (const TomlEntry& value : whole) set(table, value.key, value.value);
            } else {
                table_at(table, e.key) = std::move(whole);
            }
        }
    if (!chosen.empty()) drop(table, chosen);
    set(table, "position", to_value(camera.position));
    set(table, "target", to_value(camera.target));
    set(table, "up", to_value(camera.up));
    set(table, "fov", {.data = camera.fov_deg});
}

void set_render_options(Entries& root, const RenderSettings& settings)
{
    for (const RenderOption& option : render_options()) {
        if (!is_given(settings, option)) continue;
        TomlValue value = parse_toml_value(value_text(settings, option));
        if (std::holds_alternative<SizeField>(option.field))
            value = {.data = TomlValue::Array{{.data = int64_t{settings.size.width}},
                                              {.data = int64_t{settings.size.height}}}};
        set(table_at(root, "render"), std::string(option.name), std::move(value));
    }
}

// --smooth is for meshes that say nothing of it.
void set_smoothing(Entries& root, const Smoothing& smoothing)
{
    const bool off = smoothing.faces == Smoothing::Faces::none;
    const TomlValue value = off ? TomlValue{.data = std::string("off")} : TomlValue{.data = smoothing.largest_deg};
    for (TomlValue& mesh : std::get<TomlValue::Array>(entry(root, "mesh", {.data = TomlValue::Array{}}).data))
        entry(std::get<Entries>(mesh.data), "smooth", value);
}

fs::path folder_of(const std::string& file)
{
    std::error_code problem;
    return fs::weakly_canonical(fs::absolute(file, problem).parent_path(), problem);
}

fs::path common_folder(const fs::path& a, const fs::path& b)
{
    fs::path common;
    for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end() && *i == *j; ++i, ++j) common /= *i;
    return common;
}

// Names a file of the tables of a list, which goes by `name` there, by its whole path.
void name_wholly(Entries& root, const std::string& list, const std::string& name, const std::string& file)
{
    for (TomlValue& table : std::get<TomlValue::Array>(entry(root, list, {.data = TomlValue::Array{}}).data))
        for (TomlEntry& e : std::get<Entries>(table.data))
            if (const auto* named = std::get_if<std::string>(&e.value.data); named && e.key == "file" && *named == name)
                e.value.data = (folder_of(file) / fs::path(file).filename()).string();
}

// The picture of --env is named from the working folder, those of scene files from theirs. It and the bare mesh may
// have no folder in common from which short names would lead to both.
void name_environment(Entries& root, const SceneChoice& choice)
{
    if (choice.env.empty()) return;
    name_wholly(root, "light", choice.env, choice.env);
    name_wholly(root, "mesh", fs::path(choice.file).filename().string(), choice.file);
}

// The first override that matches counts: it comes before all others, with what the one says that has counted so far.
void override_material(Entries& root, const MaterialEdit& edit)
{
    auto& overrides = std::get<TomlValue::Array>(entry(root, "material_override", {.data = TomlValue::Array{}}).data);
    Entries table;
    for (const TomlValue& o : overrides) {
        Entries there = std::get<Entries>(o.data);
        if (!is_overridden(edit.material, std::get<std::string>(entry(there, "match", {.data = std::string()}).data)))
            continue;
        table = std::move(there);
        break;
    }
    set(table, "match", {.data = pattern_of(edit.material)});
    for (const auto& [key, value] : edit.values) set(table, key, parse_toml_value(value));
    overrides.insert(overrides.begin(), {.data = std::move(table)});
}

}  // namespace

std::string asset_root_for(const std::string& file, const SceneChoice& choice)
{
    const fs::path folder = folder_of(choice.file);
    fs::path root = choice.asset_root.empty() ? folder : folder_of(choice.asset_root + "/.");
    if (!choice.env.empty()) root = common_folder(root, folder_of(choice.env));
    return root == folder_of(file) ? "" : root.string();
}

std::string completed_scene_text(const SceneChoice& choice, const std::string& added, const CameraDescription& camera,
                                 const RenderSettings& settings, const OutputDescription& output,
                                 const SceneEdits& edits)
{
    Diagnostics none;  // all of it has been read before
    const std::optional<uint32_t> frame = choice.turntable ? std::nullopt : choice.frame;
    TomlValue tree = scene_tree(choice.file, choice.definitions, none, frame);
    auto& root = std::get<Entries>(tree.data);
    if (const std::optional<TomlValue> more = parse_toml(added, choice.file, none)) {
        Entries what = std::get<Entries>(more->data);
        for (const char* const known : {"version", "mesh", "camera"}) drop(what, known);
        merge(root, what);
    }
    name_environment(root, choice);
    if (choice.smoothing) set_smoothing(root, *choice.smoothing);
    set_camera(root, choice.camera, camera);
    set_render_options(root, settings);
    if (output.exposure && output.exposure->is_automatic)
        set(table_at(root, "output"), "exposure", {.data = std::string("auto")});
    else if (output.exposure)
        set(table_at(root, "output"), "exposure", {.data = static_cast<double>(output.exposure->stops)});
    if (output.tonemap) set(table_at(root, "output"), "tonemap", {.data = std::string(name_of(*output.tonemap))});
    if (output.denoise) set(table_at(root, "output"), "denoise", {.data = *output.denoise});
    TomlProblems problems({choice.file});
    for (const MaterialEdit& edit : edits.materials) override_material(root, edit);
    for (const std::string& edit : edits.definitions) {
        const Definition definition = parse_definition(edit);
        define(tree, definition, parse_toml_value(definition.value), problems);
    }
    Diagnostics of_edits;
    problems.report(of_edits);
    of_edits.throw_if_errors();
    set(root, "version", {.data = int64_t{1}});
    if (!is_mesh(choice.file))
        if (const auto edited = edited_toml_text(read_input_text(choice.file), tree)) return *edited;
    drop(root, "version");
    return "version = 1\n" + to_toml_text(tree);
}

}  // namespace lancer
