// The command lines of the commands that tell of scenes and pictures.
#include <algorithm>
#include <filesystem>
#include <limits>
#include <utility>

#include "app/console.h"
#include "app/options/file_kinds.h"
#include "app/options/option_values.h"
#include "app/options/picture_options.h"
#include "app/options/shared_options.h"
#include "app/paths.h"

namespace lancer {

void check_study_options(const std::vector<std::string>& words)
{
    for (const std::string& word : words)
        if (word == "-h" || word == "--help" || word == "--version")
            fail_usage(in_quotes(word) + " is not for studies");
    PictureOptions picture;
    OptionParser safe("lancer render", "", "");
    add_picture_options(safe, picture);
    RenderOptions render;
    OptionParser all("lancer render", "", "");
    add_render_options(all, render);
    std::vector<std::string> with_scene{"scene.toml"};
    with_scene.insert(with_scene.end(), words.begin(), words.end());
    all.parse(std::move(with_scene));
    constexpr std::string_view more[] = {"--tile", "--batch", "--crop", "--denoise", "--time", "--error", "--quiet"};
    for (const std::string& name : all.given())
        if (!safe.knows(name) && std::find(std::begin(more), std::end(more), name) == std::end(more))
            fail_usage(in_quotes(name) + " is not for studies: it does not say what is rendered");
}

PictureOptions parse_picture_options(std::vector<std::string> words)
{
    PictureOptions o;
    OptionParser p("lancer render", "", "");
    add_picture_options(p, o);
    if (!p.parse(std::move(words))) fail_usage("asks for help");
    return o;
}

std::optional<VerifyOptions> parse_verify(int argc, char** argv)
{
    VerifyOptions o;
    OptionParser p("lancer verify",
                   "Trace pixels of a picture again, from what its header says, and compare every bit: whether this "
                   "program drew this picture of this scene.",
                   "Exit codes: 0 all pixels are the same; 1 some differ; 2 wrong usage; 65 the picture does not say "
                   "how it was made,\nor scene or asset invalid; 66 input missing.\n\n"
                   "Example:\n  lancer verify picture.exr scene.toml\n");
    p.argument("PICTURE", "EXR of lancer render or lancer merge", [&](const std::string& t) { o.picture = t; });
    p.takes_files(files::exr);
    p.argument(
        "SCENE", "Its scene (the one that the picture names)", [&](const std::string& t) { o.scene = t; }, false);
    p.takes_files(files::scenes);
    p.value("--pixels", "N|all", "How many, drawn at random (200)",
            [&](const std::string& t) { o.pixels = t == "all" ? 0 : to_count("--pixels", t, 1); });
    p.value("--asset-root", "FOLDER", "Files that the scene names may lie anywhere in here (as the picture says)",
            [&](const std::string& t) { o.asset_root = t; });
    add_threads(p, o.threads);
    add_memory(p, o.memory);
    add_json(p, o.json);
    if (!p.parse(argc, argv)) return {};
    take_environment(o.threads);
    return o;
}

std::optional<SlurmOptions> parse_slurm(int argc, char** argv)
{
    SlurmOptions o;
    OptionParser p(
        "lancer slurm",
        "Print a job script that renders a scene in shards on a Slurm cluster and merges them: docs/farm.md.",
        "Exit codes: 0 done; 2 wrong usage.\n\n"
        "Example:\n  lancer slurm scene.toml --shards 16 -o picture.exr --render='-s 4096' > job.sh\n  sh job.sh\n");
    p.argument("SCENE", "Scene file (.toml) or mesh (.obj, .ply, .gltf, .glb)",
               [&](const std::string& t) { o.scene = t; });
    p.takes_files(files::scenes);
    p.value("-o,--output", "FILE", "Picture, .exr, .png, .ppm, .jpg or .hdr (NAME.exr in this folder)",
            [&](const std::string& t) { o.output = to_output(t, {}); });
    p.takes_files(files::written_pictures);
    p.value("--shards", "N", "Parts of each picture (1)",
            [&](const std::string& t) { o.shards = to_count("--shards", t, 1, 1u << 20); });
    p.value("--frames", "A-B",
            "Frames of an [animation], or numbered scene files, where the name of the scene has ####",
            [&](const std::string& t) { o.frames = to_frames("--frames", t); });
    p.values("--render", "OPTIONS", "More options of lancer render: --render='-s 4096 --aov albedo'",
             [&](const std::string& t) { o.render.push_back(t); });
    if (!p.parse(argc, argv)) return {};
    if (o.output.empty()) o.output = scene_name_of(o.scene) + ".exr";
    if (o.frames && o.output.find('#') == std::string::npos)
        fail_usage("--frames: " + in_quotes(o.output) + " has no #### for the number");
    return o;
}

std::optional<CheckOptions> parse_check(int argc, char** argv)
{
    CheckOptions o;
    OptionParser p(
        "lancer check", "Print every problem of a scene and its files, one line each, and count them.",
        "Exit codes: 0 no errors; 2 wrong usage; 65 errors, or with --strict warnings; 66 a file is missing; "
        "71 the\npictures need more than --memory.\n\n"
        "Example:\n  lancer check scene.toml --strict\n");
    add_scene_options(p, o.scene);
    add_threads(p, o.threads);
    add_memory(p, o.memory);
    p.flag("--strict", "Exit with 65 if there is a warning", o.strict);
    add_json(p, o.json);
    if (!p.parse(argc, argv)) return {};
    take_environment(o.threads);
    return o;
}

std::optional<InfoOptions> parse_info(int argc, char** argv)
{
    InfoOptions o;
    OptionParser p("lancer info", "Print what is in a scene, and what it costs, or what a picture says of its making.",
                   "Exit codes: 0 done; 2 wrong usage; 65 scene, asset or picture invalid; 66 input missing; "
                   "71 the\npictures need more than --memory.\n\n"
                   "Examples:\n  lancer info scene.toml\n  lancer info scene.toml --plan\n  lancer info picture.exr\n");
    add_scene_options(p, o.scene, "Scene file (.toml), mesh (.obj, .ply, .gltf, .glb) or picture (.exr, .png, ...)",
                      files::scenes_and_pictures);
    add_threads(p, o.threads);
    add_memory(p, o.memory);
    p.flag("--plan", "Also what a pilot learns of the scene: splitting, where and which light is sampled", o.plan);
    p.value("--plan-map", "FILE.png",
            "That, and a map of how often light is sampled: white always, black never or nothing",
            [&](const std::string& t) {
                if (extension_of(t) != ".png") fail_usage("--plan-map: " + in_quotes(t) + " must end in .png");
                o.plan = true, o.plan_map = t;
            });
    p.takes_files(files::png);
    add_json(p, o.json);
    if (!p.parse(argc, argv)) return {};
    if (o.json && o.plan) fail_usage("--plan: is a text and does not go with --json");
    // What a picture says takes one thread and little memory, whatever a script allows.
    if (!is_scene(o.scene.file))
        for (const std::string& name : p.given())
            if (name != "--threads" && name != "--memory" && name != "--json")
                fail_usage(name + ": is for scenes, and " + in_quotes(o.scene.file) +
                           " does not end in .toml, .obj, .ply, .gltf or .glb");
    take_environment(o.threads);
    return o;
}

std::optional<ExportOptions> parse_export(int argc, char** argv)
{
    ExportOptions o;
    OptionParser p(
        "lancer export",
        "Write a scene as other renderers can read it: scene.json, with every name resolved, a plain OBJ file of "
        "triangles for each mesh, and EXR files of linear numbers for textures and the environment. A scene with "
        "anything that these cannot say is refused.",
        "Exit codes: 0 done; 1 cannot write; 2 wrong usage; 65 scene or asset invalid, or more than can be "
        "exported; 66 input missing.\n\nExample:\n  lancer export scene.toml -o exported --size 512x512\n");
    add_picture_options(p, o.picture);
    p.group("What is written");
    p.value("-o,--output", "FOLDER", "Where to; made if it is not there", [&](const std::string& t) { o.folder = t; });
    if (!p.parse(argc, argv)) return {};
    if (o.folder.empty()) fail_usage("--output: no folder to write into; say -o FOLDER");
    take_environment(o.picture.threads);
    return o;
}

std::optional<TuneOptions> parse_tune(int argc, char** argv)
{
    TuneOptions o;
    OptionParser p(
        "lancer tune",
        "Measure what each estimator gives on a scene: small pictures with it and without it, in turns. "
        "Ratios are of the other value to that of the settings, with 95 % intervals.",
        exit_codes_help + std::string(interrupted_help) + "\nExample:\n  lancer tune scene.toml --time 2m\n");
    add_picture_options(p, o.picture);
    p.value("--time", "T", "No round begins after T: 60s, 5m, 2h; at least three are drawn (30s)",
            [&](const std::string& t) { o.seconds = to_seconds("--time", t); });
    p.flag("-q,--quiet", "Only warnings, errors and the result", o.quiet);
    if (!p.parse(argc, argv)) return {};
    take_environment(o.picture.threads);
    return o;
}

std::optional<PixelOptions> parse_pixel(int argc, char** argv)
{
    PixelOptions o;
    OptionParser p(
        "lancer pixel", "Trace one sample of a pixel again, with the same bits, and print every vertex.",
        exit_codes_help + std::string(interrupted_help) + "\nExample:\n  lancer pixel scene.toml 231 40 17 --seed 3\n");
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

std::optional<StudyOptions> parse_study(int argc, char** argv)
{
    StudyOptions o;
    OptionParser p("lancer study",
                   "Measure error against run time: methods on scenes with many seeds, as one HTML page.",
                   "An interrupt ends a study; the same command goes on where it ended.\n\n"
                   "Exit codes: 0 done; 1 a run failed; 2 wrong usage; 65 study or scene invalid; 66 input missing;\n"
                   "130 interrupted.\n\nExample:\n  lancer study study.toml -o study\n");
    p.argument("STUDY", "Study file (.toml); docs/measuring.md tells its keys",
               [&](const std::string& t) { o.study = t; });
    p.takes_files(files::toml);
    p.flag("--allow-peers", "Let the study start the other programs that it names", o.allow_peers);
    p.value("-o,--output", "FOLDER", "Where pictures, figures and index.html go (named as the study)",
            [&](const std::string& t) { o.folder = t; });
    add_threads(p, o.threads);
    if (!p.parse(argc, argv)) return {};
    if (o.folder.empty()) o.folder = std::filesystem::path(o.study).stem();
    take_environment(o.threads);
    return o;
}

std::optional<OptionsOptions> parse_options(int argc, char** argv)
{
    OptionsOptions o;
    OptionParser p("lancer options", "Print the render settings as a table in Markdown: the keys of [render].",
                   "Exit codes: 0 done; 2 wrong usage.\n\nExample:\n  lancer options --biases\n");
    p.flag("--biases", "The bias ledger instead: the entries of lancer:bias in picture headers", o.biases);
    p.value("--pages", "FOLDER",
            "Instead write manual pages, completions of shells and docs/cli.md into FOLDER, for packages of lancer",
            [&](const std::string& t) { o.pages = t; });
    if (!p.parse(argc, argv)) return {};
    return o;
}

std::optional<CompareOptions> parse_compare(int argc, char** argv)
{
    CompareOptions o;
    OptionParser p(
        "lancer compare",
        "Print how far a picture is from a reference, draw where, and say whether it is more than noise.",
        "Exit codes: 0 done, or within the limit; 1 beyond it; 2 wrong usage; 65 unreadable or not of the same size;\n"
        "66 missing.\n\nThe last line is a verdict. For more than errors both pictures must be EXR of render --aov "
        "variance, of\n"
        "different --seed.\n\nExamples:\n  lancer compare picture.exr reference.exr --fail-above 0.01\n"
        "  lancer compare picture.exr reference.exr -o where.png\n");
    p.argument("PICTURE", "Picture: EXR, PNG, HDR, JPEG, TIFF, ...", [&](const std::string& t) { o.picture = t; });
    p.takes_files(files::read_pictures);
    p.argument("REFERENCE", "What it should be", [&](const std::string& t) { o.reference = t; });
    p.takes_files(files::read_pictures);
    const auto second = [&](const std::string& t) { o.reference2 = t; };
    p.argument("REFERENCE2", "The same as --reference2", second, false);
    p.takes_files(files::read_pictures);
    p.value("--reference2", "FILE", "A second, independent reference: noise of the references cancels out", second);
    p.takes_files(files::read_pictures);
    p.value("--metric", listed(enum_names<Metric>),
            "What the limit is for (relmse; with two references its unbiased form)",
            [&](const std::string& t) { o.metric = to_enum<Metric>("--metric", t); });
    p.flag("--steps", "Compare what 8-bit pictures hold, 0 to 255, as it stands in the files: no linear light",
           o.steps);
    p.value("--fail-above", "X", "Exit with 1 if the error is above X or not a number", [&](const std::string& t) {
        o.fail_above = to_number<double>("--fail-above", t, 0, std::numeric_limits<double>::max(), "a number");
    });
    p.values("-o,--output", "FILE",
             "Map of the errors: .png, .ppm or .jpg in colours, .exr or .hdr as numbers; may be given several times",
             [&](const std::string& t) { o.outputs.push_back(t); });
    p.takes_files(files::written_pictures);
    add_format(p, o.format);
    p.value("--map", listed(enum_names<ErrorMap>),
            "What the map shows: FLIP from 0 to 1, or the relative squared error in powers of ten from 1e-5 to 10 "
            "(flip)",
            [&](const std::string& t) { o.map = to_enum<ErrorMap>("--map", t); });
    add_json(p, o.json);
    if (!p.parse(argc, argv)) return {};
    take_outputs(o.outputs, o.format);
    refuse_doubles(o.outputs);
    return o;
}

}  // namespace lancer
