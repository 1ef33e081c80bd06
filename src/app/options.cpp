#include "app/options.h"

#include <CLI/CLI.hpp>

#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>

#include "app/console.h"
#include "app/paths.h"
#include "app/settings.h"
#include "app/version.h"
#include "core/names.h"
#include "io/definition.h"
#include "scene/description.h"

namespace lancer {
namespace {

constexpr uint32_t max_count = (uint32_t{1} << 31) - 1;
constexpr uint32_t max_threads = 1024;

[[noreturn]] void fail(const std::string& message) { throw Error(ErrorKind::usage, {}, message); }

std::string to_text(double x) { return shortest(x); }
std::string to_text(std::integral auto x) { return std::to_string(x); }

template <class T>
T to_number(const std::string& option, const std::string& text, T least, T most, const char* what)
{
    T value{};
    const char* const end = text.data() + text.size();
    const char* const begin = text.starts_with('+') ? text.data() + 1 : text.data();
    const auto [rest, problem] = std::from_chars(begin, end, value);
    if (problem != std::errc{} || rest != end || begin == end || !(value >= least && value <= most))
        fail(option + ": " + in_quotes(text) + " is not " + what + " from " + to_text(least) + " to " + to_text(most));
    return value;
}
uint32_t to_count(const std::string& option, const std::string& text, uint32_t least, uint32_t most = max_count)
{
    return to_number<uint32_t>(option, text, least, most, "a whole number");
}

std::vector<std::string> split(const std::string& text, char separator)
{
    std::vector<std::string> parts{""};
    for (const char c : text) {
        if (c == separator) {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

std::array<uint32_t, 2> to_size(const std::string& text)
{
    const auto parts = split(text, 'x');
    if (parts.size() != 2) fail("--size: " + in_quotes(text) + " is not WIDTHxHEIGHT, such as 1280x720");
    const std::array<uint32_t, 2> size{to_count("--size", parts[0], 1, max_picture_side),
                                       to_count("--size", parts[1], 1, max_picture_side)};
    if (uint64_t{size[0]} * size[1] > max_picture_pixels)
        fail("--size: " + in_quotes(text) + " is too large: at most 2^28 pixels");
    return size;
}

Tile to_crop(const std::string& text)
{
    const auto parts = split(text, ',');
    if (parts.size() != 4) fail("--crop: " + in_quotes(text) + " is not x0,y0,x1,y1 (pixels, x1 and y1 exclusive)");
    std::array<uint32_t, 4> c{};
    for (size_t i = 0; i < 4; ++i) c[i] = to_count("--crop", parts[i], 0, max_picture_side);
    if (c[0] >= c[2] || c[1] >= c[3]) fail("--crop: " + in_quotes(text) + " is empty: x0 < x1 and y0 < y1 are needed");
    return {c[0], c[1], c[2], c[3]};
}

template <class Names>
std::string to_name(const std::string& option, const std::string& text, const Names& known)
{
    if (std::find(known.begin(), known.end(), text) == known.end())
        fail(option + ": unknown name " + in_quotes(text) + suggestion(text, known));
    return text;
}

// "nee=false,mis=true"
void set_switches(const std::string& text, PictureOptions& o)
{
    const std::vector<std::string_view> known{"nee", "mis", "multiscatter", "terminator"};
    for (const std::string& part : split(text, ',')) {
        const size_t equals = part.find('=');
        const std::string value = equals == std::string::npos ? "" : part.substr(equals + 1);
        const std::string name = to_name("--set", part.substr(0, equals), known);
        if (value != "true" && value != "false")
            fail("--set: " + in_quotes(part) + " is not " + name + "=true or =false");
        const bool on = value == "true";
        if (name == "nee") o.direct.nee = on;
        if (name == "mis") o.direct.mis = on;
        if (name == "multiscatter") o.multiscatter = on;
        if (name == "terminator") o.terminator = on;
    }
}

std::string to_output(const std::string& path)
{
    const std::string extension = extension_of(path);
    if (extension != ".exr" && extension != ".png") fail("--output: " + in_quotes(path) + " must end in .exr or .png");
    return path;
}

// "albedo,normal" or "all"
void add_aovs(const std::string& text, std::vector<Aov>& aovs)
{
    std::vector<std::string_view> known(aov_names.begin(), aov_names.end());
    known.push_back("all");
    for (const std::string& part : split(text, ',')) {
        to_name("--aov", part, known);
        for (size_t i = 0; i < aov_names.size(); ++i)
            if (part == "all" || part == aov_names[i]) aovs.push_back(static_cast<Aov>(i));
    }
    std::sort(aovs.begin(), aovs.end());
    aovs.erase(std::unique(aovs.begin(), aovs.end()), aovs.end());
}

// The options of one command. Every value comes as text and is turned into what it means by a function that throws
// Error, so that messages are our own.
class Parser {
public:
    using Take = std::function<void(const std::string&)>;

    Parser(const std::string& command, const std::string& description, const std::string& footer)
        : app_(description, "lancer " + command)
    {
        app_.get_formatter()->column_width(32);
        app_.allow_extras();
        app_.footer(footer);
        app_.set_help_flag("-h,--help", "Print this and exit");
        app_.add_flag("--version", version_, "Print the versions of the program and its libraries and exit");
    }

    void argument(const std::string& name, const std::string& help, const Take& take, bool required = true)
    {
        add(name, help, take)->required(required)->option_text(" ");
    }
    // The last one counts.
    void value(const std::string& names, const std::string& type, const std::string& help, const Take& take)
    {
        add(names, help, take)->option_text(type);
    }
    // Each one counts.
    void values(const std::string& names, const std::string& type, const std::string& help, const Take& take)
    {
        add(names, help, take)->option_text(type)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    }
    void flag(const std::string& names, const std::string& help, bool& set) { app_.add_flag(names, set, help); }
    void group(const std::string& name) { app_.option_defaults()->group(name); }

    // False if help or version was asked for and printed.
    bool parse(int argc, char** argv)
    {
        try {
            app_.parse(argc, argv);
        } catch (const CLI::CallForHelp&) {
            print_result(app_.help());
            return false;
        } catch (const CLI::ParseError& e) {
            if (version_) return print_version();
            check_extras();
            fail(std::string(e.what()) + "; see " + app_.get_name() + " --help");
        }
        if (version_) return print_version();
        check_extras();
        return true;
    }

private:
    CLI::Option* add(const std::string& names, const std::string& help, const Take& take)
    {
        const auto all = [take](const CLI::results_t& texts) {
            for (const std::string& text : texts) take(text);
            return true;
        };
        return app_.add_option(names, all, help)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    }
    static bool print_version()
    {
        print_result(version_text());
        return false;
    }
    void check_extras() const
    {
        std::vector<std::string> known;
        for (const CLI::Option* option : app_.get_options())
            for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
        for (const std::string& extra : app_.remaining()) {
            if (extra == "--") continue;  // what follows it are arguments, also with a '-' in front
            if (!extra.starts_with('-')) fail("unexpected argument " + in_quotes(extra));
            const std::string name = extra.substr(0, extra.find('='));
            const auto meant = nearest(name, known);
            fail("unknown option " + in_quotes(name) + (meant ? "; did you mean " + in_quotes(*meant) + "?" : "") +
                 "; see " + app_.get_name() + " --help");
        }
    }

    CLI::App app_;
    bool version_ = false;
};

std::string listed(const std::vector<std::string_view>& names)
{
    std::string text;
    for (const std::string_view name : names) text += (text.empty() ? "" : "|") + std::string(name);
    return text;
}

void add_name(Parser& p, const std::string& option, const std::string& help, const std::vector<std::string_view>& known,
              std::optional<std::string>& value)
{
    p.value(option, listed(known), help,
            [=, &known, &value](const std::string& t) { value = to_name(option, t, known); });
}

void add_scene_options(Parser& p, SceneChoice& o,
                       const char* help = "Scene file (.toml) or mesh (.obj: camera and light are added)")
{
    p.argument("SCENE", help, [&](const std::string& t) { o.file = t; });
    p.group("The scene");
    p.value("--camera", "NAME", "Its [camera.NAME] ([camera])", [&](const std::string& t) { o.camera = t; });
    p.values("-D", "KEY=VALUE", "A value over that of the scene file: camera.fov=35, light.0.radiance=[1,2,3]",
             [&](const std::string& t) {
                 parse_definition(t);
                 o.definitions.push_back(t);
             });
    p.value("--asset-root", "FOLDER", "Files that the scene names may lie anywhere in here (its own folder)",
            [&](const std::string& t) { o.asset_root = t; });
}

void add_threads(Parser& p, std::optional<uint32_t>& threads)
{
    p.value("-t,--threads", "N", "Threads; pictures do not depend on it (LANCER_THREADS, else all CPUs allowed)",
            [&](const std::string& t) { threads = to_count("--threads", t, 1, max_threads); });
}

void add_picture_options(Parser& p, PictureOptions& o)
{
    add_scene_options(p, o.scene);
    p.group("What decides the picture (over [render] of the scene)");
    p.value("--size", "WxH", "Size in pixels (1280x720)", [&](const std::string& t) { o.size = to_size(t); });
    p.value("--seed", "N", "Other random numbers (0)", [&](const std::string& t) {
        o.seed = to_number<uint64_t>("--seed", t, 0, std::numeric_limits<int64_t>::max(), "a whole number");
    });
    add_name(p, "--integrator", "How light is followed (path)", integrator_names, o.integrator);
    p.value("--max-depth", "N", "Surface vertices of a path; 1 is direct light only, 0 no limit (0)",
            [&](const std::string& t) { o.max_depth = to_count("--max-depth", t, 0); });
    p.values(
        "--set", "NAME=true|false,...",
        "Switches: nee (light sampling), mis (multiple importance sampling), multiscatter (rough materials lose no "
        "light), terminator (softer shadow edges on smoothed meshes)",
        [&](const std::string& t) { set_switches(t, o); });
    add_name(p, "--sampler", "Random numbers (sobol)", sampler_names, o.sampler);
    add_name(p, "--filter", "Pixel filter (blackman-harris)", filter_names, o.filter);
    add_name(p, "--accel", "Ray intersection; list tries every primitive (embree)", accel_names, o.accel);
    add_name(p, "--isa", "Instructions of Embree; others round differently (avx2)", isa_names, o.isa);
    p.group("How it runs");
    add_threads(p, o.threads);
    p.flag("--strict", "Fail if loading the scene gives a warning", o.strict);
}

// After the options, so that a wrong value in the environment does not stand in the way of a right one.
void take_environment(std::optional<uint32_t>& said)
{
    const char* const threads = std::getenv("LANCER_THREADS");
    if (!said && threads && *threads) said = to_count("LANCER_THREADS", threads, 1, max_threads);
}

ProgressKind to_progress(const std::string& text)
{
    const std::vector<std::string_view> known{"auto", "plain", "json", "none"};
    to_name("--progress", text, known);
    return text == "plain"  ? ProgressKind::plain
           : text == "json" ? ProgressKind::json
           : text == "none" ? ProgressKind::none
                            : ProgressKind::automatic;
}

const char* const exit_codes =
    "Exit codes: 0 done; 1 failed at run time; 2 wrong usage; 65 scene or asset invalid; 66 input missing;\n"
    "130 interrupted (the picture so far is written, marked partial).\n";

void add_render_options(Parser& p, RenderOptions& o)
{
    add_picture_options(p, o.picture);
    p.value("--progress", "auto|plain|json|none", "auto is a line on a terminal, else plain (auto)",
            [&](const std::string& t) { o.progress = to_progress(t); });
    p.value("--tile", "N", "Side of a tile in pixels; pictures do not depend on it (16)",
            [&](const std::string& t) { o.tile = to_count("--tile", t, 1, 4096); });
    p.value("--batch", "N", "Paths traced together; pictures do not depend on it (256)",
            [&](const std::string& t) { o.batch = to_count("--batch", t, 1, 1 << 20); });
    p.flag("-q,--quiet", "Only warnings and errors", o.quiet);
    p.flag("-v,--verbose", "Also say what was loaded and with what settings", o.verbose);
    p.group("What is written");
    p.values("-o,--output", "FILE", "Picture, .exr or .png; may be given several times (NAME.exr in this folder)",
             [&](const std::string& t) { o.outputs.push_back(to_output(t)); });
    p.value("-s,--spp", "N", "Samples per pixel (64)", [&](const std::string& t) { o.spp = to_count("--spp", t, 1); });
    p.value("--crop", "x0,y0,x1,y1", "Only these pixels; x1 and y1 are exclusive",
            [&](const std::string& t) { o.crop = to_crop(t); });
    p.values(
        "--aov", "NAME,...",
        "More channels of EXR pictures: albedo, normal, depth, position, uv, material, variance, mask, flat, or all",
        [&](const std::string& t) { add_aovs(t, o.aovs); });
    p.flag("--half", "EXR with 16-bit floats; AOVs keep 32 bits", o.half);
    p.value("--tonemap", "srgb|agx|none",
            "PNG: the sRGB curve, cut off at 1; AgX, which rolls off; or linear values (srgb)",
            [&](const std::string& t) {
                const std::vector<std::string_view> known{"srgb", "agx", "none"};
                to_name("--tonemap", t, known);
                o.tonemap = t == "agx" ? ToneMap::agx : t == "none" ? ToneMap::none : ToneMap::srgb;
            });
    p.value("--exposure", "STOPS", "PNG is brightened by 2^STOPS (0)",
            [&](const std::string& t) { o.exposure_stops = to_number<float>("--exposure", t, -64, 64, "a number"); });
    p.flag("--dither", "PNG with a fixed dither pattern against banding", o.dither);
    p.value("--stats", "FILE", "Figures of the run as JSON", [&](const std::string& t) { o.stats = t; });
}

// With links followed as far as there are files: two names of one file are equal. Absolute first: of a relative path
// that does not exist, weakly_canonical would leave a relative one.
std::filesystem::path place_of(const std::string& path)
{
    std::error_code problem;
    const std::filesystem::path place = std::filesystem::weakly_canonical(std::filesystem::absolute(path), problem);
    return problem ? std::filesystem::path(path).lexically_normal() : place;
}

}  // namespace

std::optional<RenderOptions> parse_render(int argc, char** argv)
{
    RenderOptions o;
    Parser p(
        "render", "Render a scene into pictures.",
        exit_codes + std::string("Signals: a second interrupt exits at once; SIGUSR1 writes a snapshot and goes on.\n\n"
                                 "Examples:\n  lancer render scene.toml -s 256 -o picture.exr -o picture.png\n"
                                 "  lancer mesh.obj --size 640x360\n"));
    add_render_options(p, o);
    if (!p.parse(argc, argv)) return {};
    take_environment(o.picture.threads);
    if (o.outputs.empty()) o.outputs.push_back(std::filesystem::path(o.picture.scene.file).stem().string() + ".exr");
    std::vector<std::string> files = o.outputs;
    if (!o.stats.empty()) files.push_back(o.stats);
    for (size_t i = 0; i < files.size(); ++i)
        for (size_t j = 0; j < i; ++j)
            if (place_of(files[i]) == place_of(files[j])) fail("--output: " + in_quotes(files[i]) + " is named twice");
    o.command_line = "lancer render";
    for (int i = 1; i < argc; ++i) o.command_line += " " + in_shell_quotes(argv[i]);
    return o;
}

std::optional<CheckOptions> parse_check(int argc, char** argv)
{
    CheckOptions o;
    Parser p("check", "Print every problem of a scene and its files, one line each, and count them.",
             "Exit codes: 0 no errors; 2 wrong usage; 65 errors, or with --strict warnings; 66 a file is missing.\n\n"
             "Example:\n  lancer check scene.toml --strict\n");
    add_scene_options(p, o.scene);
    add_threads(p, o.threads);
    p.flag("--strict", "Exit with 65 if there is a warning", o.strict);
    if (!p.parse(argc, argv)) return {};
    take_environment(o.threads);
    return o;
}

std::optional<InfoOptions> parse_info(int argc, char** argv)
{
    InfoOptions o;
    Parser p("info", "Print what is in a scene, and what it costs, or what a picture says of its making.",
             "Exit codes: 0 done; 2 wrong usage; 65 scene, asset or picture invalid; 66 input missing.\n\n"
             "Examples:\n  lancer info scene.toml\n  lancer info picture.exr\n");
    add_scene_options(p, o.scene, "Scene file (.toml), mesh (.obj) or picture (.exr, .png, ...)");
    add_threads(p, o.threads);
    if (!p.parse(argc, argv)) return {};
    take_environment(o.threads);
    return o;
}

std::optional<PixelOptions> parse_pixel(int argc, char** argv)
{
    PixelOptions o;
    Parser p("pixel", "Trace one sample of a pixel again, with the same bits, and print every vertex.",
             exit_codes + std::string("\nExample:\n  lancer pixel scene.toml 231 40 17 --seed 3\n"));
    add_picture_options(p, o.picture);
    p.argument("X", "Pixel, from the left of the whole picture",
               [&](const std::string& t) { o.x = to_count("X", t, 0); });
    p.argument("Y", "Pixel, from the top of the whole picture",
               [&](const std::string& t) { o.y = to_count("Y", t, 0); });
    p.argument(
        "SAMPLE", "Number of the sample (0)", [&](const std::string& t) { o.sample = to_count("SAMPLE", t, 0); },
        false);
    if (!p.parse(argc, argv)) return {};
    take_environment(o.picture.threads);
    return o;
}

std::optional<CompareOptions> parse_compare(int argc, char** argv)
{
    CompareOptions o;
    Parser p(
        "compare", "Print how far a picture is from a reference.",
        "Exit codes: 0 done, or within the limit; 1 beyond it; 2 wrong usage; 65 unreadable or not of the same size;\n"
        "66 missing.\n\nExample:\n  lancer compare picture.exr reference.exr --fail-above 0.01\n");
    p.argument("PICTURE", "Picture: EXR, PNG, HDR, JPEG, TIFF, ...", [&](const std::string& t) { o.picture = t; });
    p.argument("REFERENCE", "What it should be", [&](const std::string& t) { o.reference = t; });
    const auto second = [&](const std::string& t) { o.reference2 = t; };
    p.argument("REFERENCE2", "The same as --reference2", second, false);
    p.value("--reference2", "FILE", "A second, independent reference: noise of the references cancels out", second);
    p.value("--metric", "rmse|relmse", "What the limit is for (relmse; with two references its unbiased form)",
            [&](const std::string& t) {
                const std::vector<std::string_view> known{"rmse", "relmse"};
                o.metric = to_name("--metric", t, known) == "rmse" ? Metric::rmse : Metric::relmse;
            });
    p.value("--fail-above", "X", "Exit with 1 if the error is above X or not a number", [&](const std::string& t) {
        o.fail_above = to_number<double>("--fail-above", t, 0, std::numeric_limits<double>::max(), "a number");
    });
    if (!p.parse(argc, argv)) return {};
    return o;
}

}  // namespace lancer
