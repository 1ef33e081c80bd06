#include "app/options/shared_options.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "app/options/option_values.h"
#include "io/scene/definition.h"
#include "scene/description/render_options.h"

namespace lancer {
namespace {

constexpr uint32_t max_threads = 1024;

// Sets a field to what a text of the command line says. Throws Error (usage).
struct FieldReader {
    const std::string& option;
    const std::string& text;
    RenderSettings& settings;

    void operator()(const SwitchField& field) const { settings.*field.member = to_bool(option, text); }
    void operator()(const SizeField& field) const { settings.*field.member = to_size(option, text); }
    void operator()(const ChoiceField& field) const { field.set(settings, to_choice(option, text, field.names)); }
    template <class T>
    void operator()(const NumberField<T>& field) const
    {
        const char* const what = std::integral<T> ? "a whole number" : "a number";
        settings.*field.member = to_number<T>(option, text, field.least, field.most, what);
    }
};

void read(const RenderOption& row, const std::string& option, const std::string& text, RenderSettings& settings)
{
    std::visit(FieldReader{option, text, settings}, row.field);
    mark_given(settings, row);
}

// What the help shows for a value.
std::string type_of(const RenderOption& row)
{
    if (const auto* choice = std::get_if<ChoiceField>(&row.field)) return listed(choice->names);
    if (std::holds_alternative<SizeField>(row.field)) return "WxH";
    return std::holds_alternative<NumberField<double>>(row.field) ? "X" : "N";
}

// A sentence, with the default and its unit.
std::string help_of(const RenderOption& row)
{
    std::string text(row.help);
    text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    const std::string unit = row.unit.empty() ? "" : " " + std::string(row.unit);
    return text + " (" + value_text({}, row) + unit + ")";
}

// "nee=false,mis=true"
void read_switches(const std::string& text, RenderSettings& settings)
{
    std::vector<std::string_view> known;
    for (const RenderOption& row : render_options())
        if (row.is_switch()) known.push_back(row.name);
    for (const std::string& part : split(text, ',')) {
        const std::string name = part.substr(0, part.find('='));
        to_choice("--set", name, known);
        if (part != name + "=true" && part != name + "=false")
            fail_usage("--set: " + in_quotes(part) + " is not " + name + "=true or =false");
        read(render_option(name), "--set", part.substr(name.size() + 1), settings);
    }
}

void add_switches(OptionParser& p, RenderSettings& settings)
{
    std::string help = "Switches, here with their defaults:";
    std::vector<std::string> words;
    for (const RenderOption& row : render_options()) {
        if (!row.is_switch()) continue;
        help += "\n" + std::string(row.name) + "=" + value_text({}, row) + ": " + std::string(row.help);
        for (const char* value : {"=true", "=false"}) words.push_back(std::string(row.name) + value);
    }
    p.values("--set", "NAME=true|false,...", help, [&](const std::string& t) { read_switches(t, settings); });
    p.takes_list(std::move(words));
}

void add_render_settings(OptionParser& p, RenderSettings& settings)
{
    for (const RenderOption& row : render_options()) {
        if (row.is_switch()) {
            const auto set = [&] { read(row, std::string(row.flag), "true", settings); };
            if (!row.flag.empty()) p.flag(std::string(row.flag), "As --set " + std::string(row.name) + "=true", set);
            continue;
        }
        const std::string option = option_name(row);
        const std::string names = (row.flag.empty() ? "" : std::string(row.flag) + ",") + option;
        p.value(names, type_of(row), help_of(row),
                [&settings, &row, option](const std::string& t) { read(row, option, t, settings); });
    }
    add_switches(p, settings);
}

}  // namespace

void read_setting(const RenderOption& row, const std::string& text, RenderSettings& settings)
{
    read(row, std::string(row.name), text, settings);
}

void add_scene_options(OptionParser& p, SceneChoice& o, const char* help, std::string_view endings)
{
    p.argument("SCENE", help, [&](const std::string& t) { o.file = t; });
    p.takes_files(endings);
    p.group("The scene");
    p.value("--camera", "NAME", "Its [camera.NAME] ([camera])", [&](const std::string& t) { o.camera = t; });
    p.value("--frame", "N", "Frame of its [animation], or of --turntable (the first)",
            [&](const std::string& t) { o.frame = to_count("--frame", t, 0); });
    p.value("--turntable", "N", "The camera turns around the scene in frames 0 to N-1: frame 0 is its own view",
            [&](const std::string& t) { o.turntable = to_count("--turntable", t, 1, 1000000); });
    p.value("--env", "FILE", "Of a mesh: picture all around it, in place of the sky and the key light",
            [&](const std::string& t) { o.env = t; });
    p.takes_files(files::read_pictures);
    p.flag("--no-ground", "Of a mesh: no ground below it", [&] { o.ground = false; });
    p.value("--up", listed(enum_names<UpChoice>),
            "What is up, over camera.up; auto looks for what the mesh stands on (auto for a mesh, else y)",
            [&](const std::string& t) { o.up = to_enum<UpChoice>("--up", t); });
    p.value("--view", listed_views(),
            "See all of it from there, over camera.position and camera.target; degrees from the front to the right, "
            "and above the horizon (by what there is to see)",
            [&](const std::string& t) { o.view = to_view(t); });
    p.values("-D", "KEY=VALUE", "A value over that of the scene file: camera.fov=35, light.0.radiance=[1,2,3]",
             [&](const std::string& t) {
                 parse_definition(t);
                 o.definitions.push_back(t);
             });
    p.value("--asset-root", "FOLDER", "Files that the scene names may lie anywhere in here (its own folder)",
            [&](const std::string& t) { o.asset_root = t; });
    p.value("--smooth", "ANGLE|off", "Normals of meshes without any: faces that meet at up to this angle share them",
            [&](const std::string& t) {
                o.smoothing = Smoothing{.faces = t == "off" ? Smoothing::Faces::none : Smoothing::Faces::all};
                if (t != "off")
                    o.smoothing->largest_deg = to_number<double>("--smooth", t, 0, 180, "'off' or an angle");
            });
}

void add_picture_options(OptionParser& p, PictureOptions& o)
{
    add_scene_options(p, o.scene);
    p.group("Render settings (override [render] of the scene)");
    add_render_settings(p, o.render);
    p.group("How it runs");
    add_threads(p, o.threads);
    add_memory(p, o.memory);
    p.flag("--strict", "Fail if loading the scene gives a warning", o.strict);
}

void add_memory(OptionParser& p, MemorySize& memory)
{
    p.value("--memory", "SIZE",
            "What all pictures of the scene may take together, MIP levels included: 4G, 500M, or a part of the memory "
            "that there is. More is refused (80%)",
            [&](const std::string& t) { memory = to_memory_size("--memory", t); });
}

void add_json(OptionParser& p, bool& json) { p.flag("--json", "The result as JSON: docs/json tells its keys", json); }

void add_threads(OptionParser& p, std::optional<uint32_t>& threads)
{
    p.value("-t,--threads", "N", "Threads; pictures do not depend on it (LANCER_THREADS, else all CPUs allowed)",
            [&](const std::string& t) { threads = to_count("--threads", t, 1, max_threads); });
}

void take_environment(std::optional<uint32_t>& threads)
{
    const char* const given = std::getenv("LANCER_THREADS");
    if (!threads && given && *given) threads = to_count("LANCER_THREADS", given, 1, max_threads);
}

}  // namespace lancer
