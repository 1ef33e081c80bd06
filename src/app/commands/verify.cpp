// lancer verify: whether this program drew this picture of this scene.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <random>

#include "app/commands/commands.h"
#include "app/console.h"
#include "app/options/option_values.h"
#include "app/paths.h"
#include "app/prepare.h"
#include "app/version.h"
#include "app/whole_film.h"
#include "core/names.h"
#include "core/parallel.h"
#include "io/image/exr.h"
#include "render/aov.h"
#include "report/json_object.h"
#include "report/stats_json.h"

namespace lancer {
namespace {

constexpr size_t most_shown = 5;

// A picture as its file says that it was made.
struct Claim {
    std::string scene, scene_hash, options;
    Window display, data;
    uint32_t spp_done = 0;  // what all pixels have; a render that time has stopped may have the next pass in some
    bool is_half = false, has_alpha = false, is_denoised = false;
    bool has_opaque_glass = false;  // if it has alpha
    ColorSpace space = ColorSpace::lin_rec709;
    std::vector<std::vector<float>> channels;  // red, green, blue before denoising; alpha, if there is one
};

[[noreturn]] void fail(const std::string& path, const std::string& what)
{
    throw Error(ErrorKind::invalid_input, {path}, what);
}

Claim read_claim(const std::string& path)
{
    if (format_of(path).value_or(PictureFormat::exr) != PictureFormat::exr)
        fail(path, "8 bits do not tell one picture from another; verify the EXR of the same render");
    const ExrInfo info = read_exr_info(path);
    Claim claim{.scene = text_of(info.metadata, "scene"),
                .scene_hash = text_of(info.metadata, "scene_hash"),
                .options = text_of(info.metadata, "options"),
                .display = info.display,
                .data = info.data,
                .space = info.space,
                .channels = {}};
    if (claim.options.empty()) fail(path, "its header does not say how it was made");
    if (text_of(info.metadata, "partial") != "0")
        fail(path, "it is partial: not all its pixels have all their samples");
    claim.options += " --spp " + text_of(info.metadata, "spp");
    claim.spp_done = static_cast<uint32_t>(std::strtoul(text_of(info.metadata, "spp_done").c_str(), nullptr, 10));
    if (info.compression.starts_with("dwa")) fail(path, "its compression, " + info.compression + ", changes pixels");
    if (const std::string by = text_of(info.metadata, "software"), own = std::string("lancer ") + LANCER_VERSION;
        by != own)
        print_problem(path + ": warning: drawn by " + by + ", this is " + own);
    std::vector<std::string> names{"R", "G", "B"};
    for (const ExrInfo::Channel& c : info.channels) {
        claim.has_alpha = claim.has_alpha || c.name == "A";
        claim.is_denoised = claim.is_denoised || c.name == "noisy.R";
        claim.is_half = claim.is_half || (c.name == "R" && c.type == "half");
    }
    if (claim.is_denoised) {
        for (std::string& name : names) name = "noisy." + name;
        claim.is_half = false;
    }
    claim.has_opaque_glass = text_of(info.metadata, "background") == name_of(BackgroundChoice::opaque_glass);
    if (claim.has_alpha) names.emplace_back("A");
    claim.channels = read_exr_channels(path, names);
    return claim;
}

PictureOptions options_of(const Claim& claim, const VerifyOptions& verify)
{
    std::vector<std::string> words = words_of(claim.options);
    words.insert(words.begin(), verify.scene.empty() ? claim.scene : verify.scene);
    PictureOptions options;
    try {
        options = parse_picture_options(std::move(words));
    } catch (const Error& problem) {
        fail(verify.picture, "its options are not understood: " + message_of(problem));
    }
    if (!verify.asset_root.empty()) options.scene.asset_root = verify.asset_root;
    options.threads = verify.threads;
    options.memory = verify.memory;
    return options;
}

// Places in the data window: all, or as many as are asked for, at random and each once.
std::vector<size_t> choose_pixels(size_t count, size_t wanted)
{
    std::vector<size_t> all(count);
    for (size_t i = 0; i < count; ++i) all[i] = i;
    if (wanted == 0 || wanted >= count) return all;
    std::mt19937_64 random(std::random_device{}());
    std::vector<size_t> some;
    std::sample(all.begin(), all.end(), std::back_inserter(some), wanted, random);
    return some;
}

// What a pixel's channels are when so many samples of it are traced again.
std::vector<float> traced(const Renderer& renderer, const Camera& camera, const RenderSettings& settings,
                          const Claim& claim, const Tile& pixel, uint32_t spp)
{
    Film film(settings.size.width, settings.size.height, pixel);
    if (claim.has_alpha) {
        film.hides_background = true;
        AovLayout layout;
        add_alpha_sums(!claim.has_opaque_glass, renderer.scene().catches_shadows(), layout);
        film.keep_aovs(layout);
    }
    keep_for_settings(settings, film);
    renderer.pass(camera, film, std::vector{pixel}, {0, spp});
    Color c = film.whole(0).mean();
    if (claim.space != ColorSpace::lin_rec709) c = transformed(to_space(claim.space), c);
    std::vector<float> values{c.r, c.g, c.b};
    if (claim.is_half)
        for (float& x : values) x = through_half(x);
    if (claim.has_alpha) values.push_back(alpha_of(film).values[0]);
    return values;
}

bool have_same_bits(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0; }

struct Difference {
    Tile pixel;
    std::vector<float> traced, there;
};

void print_differences(const std::vector<Difference>& all)
{
    const auto text = [](const std::vector<float>& values) {
        std::string line;
        for (const float x : values) line += (line.empty() ? "" : " ") + shortest(x);
        return line;
    };
    for (size_t i = 0; i < std::min(all.size(), most_shown); ++i)
        print_result(format_text("pixel %u %u: ", all[i].pixel.x0, all[i].pixel.y0) + text(all[i].there) +
                     " in the picture, " + text(all[i].traced) + " traced again");
    if (all.size() > most_shown) print_result(format_text("and %zu more", all.size() - most_shown));
}

// Pixels that differ, in order.
std::vector<Difference> compare(const Renderer& renderer, const Prepared& prepared, const Claim& claim,
                                const std::vector<size_t>& pixels)
{
    const RenderSettings& settings = prepared.settings;
    const Camera camera(prepared.description, renderer.scene().normalisation, settings.size.width, settings.size.height,
                        pixel_grid(settings));
    renderer.plan(camera, settings.size.width, settings.size.height);  // once, not in each thread
    std::vector<std::vector<float>> again(pixels.size());
    const auto width = static_cast<size_t>(claim.data.width());
    const auto tile_of = [&](size_t at) {
        const auto x = static_cast<uint32_t>(claim.data.x0 + static_cast<int32_t>(at % width));
        const auto y = static_cast<uint32_t>(claim.data.y0 + static_cast<int32_t>(at / width));
        return Tile{x, y, x + 1, y + 1};
    };
    const auto there = [&](size_t i) {
        std::vector<float> values;
        for (const auto& channel : claim.channels) values.push_back(channel[pixels[i]]);
        return values;
    };
    const auto is_same = [&](size_t i) {
        const std::vector<float> values = there(i);
        return std::equal(values.begin(), values.end(), again[i].begin(), have_same_bits);
    };
    parallel_for(pixels.size(), [&](size_t i) {
        const auto trace = [&](uint32_t spp) {
            again[i] = traced(renderer, camera, settings, claim, tile_of(pixels[i]), spp);
        };
        trace(settings.spp);
        if (is_same(i) || claim.spp_done == 0 || claim.spp_done >= settings.spp) return;
        trace(claim.spp_done);
    });
    std::vector<Difference> differences;
    for (size_t i = 0; i < pixels.size(); ++i)
        if (!is_same(i)) differences.push_back({tile_of(pixels[i]), again[i], there(i)});
    return differences;
}

// What verify() found.
struct Finding {
    const Claim& claim;
    std::string scene, scene_hash;  // of the scene that was traced
    size_t traced = 0;
    const std::vector<Difference>& differences;
    bool is_same_scene() const { return scene_hash == claim.scene_hash; }
};

// "lancer.verify/1": docs/json/verify.schema.json.
std::string json_of(const std::string& picture, const Finding& f)
{
    JsonObject all("lancer.verify/1");
    all.text("picture", picture);
    all.text("scene", f.scene);
    all.text("scene_hash", f.scene_hash);
    all.text("scene_hash_of_picture", f.claim.scene_hash);
    all.flag("same_scene", f.is_same_scene());
    all.count("pixels", static_cast<int64_t>(f.claim.channels[0].size()));
    all.count("traced", static_cast<int64_t>(f.traced));
    all.count("differing", static_cast<int64_t>(f.differences.size()));
    std::vector<JsonObject> shown;
    for (size_t i = 0; i < std::min(f.differences.size(), most_shown); ++i) {
        const Difference& d = f.differences[i];
        JsonObject& object = shown.emplace_back();
        object.count("x", d.pixel.x0);
        object.count("y", d.pixel.y0);
        object.numbers("in_picture", std::vector<double>(d.there.begin(), d.there.end()));
        object.numbers("traced", std::vector<double>(d.traced.begin(), d.traced.end()));
    }
    all.objects("first_differences", shown);
    all.flag("half", f.claim.is_half);
    all.flag("noisy_layer", f.claim.is_denoised);
    all.flag("verified", f.differences.empty() && f.is_same_scene());
    return all.to_text();
}

int verify(const VerifyOptions& options)
{
    const Claim claim = read_claim(options.picture);
    const PictureOptions picture = options_of(claim, options);
    Diagnostics diagnostics;
    Prepared prepared = load_prepared(picture, diagnostics, true);
    const std::string hash = to_hex(prepared.description.content_hash);
    const bool is_same_scene = hash == claim.scene_hash;
    const PictureSize& size = prepared.settings.size;
    if (Window{0, 0, static_cast<int32_t>(size.width), static_cast<int32_t>(size.height)} != claim.display ||
        claim.data.x0 < 0 || claim.data.y0 < 0 || claim.data.x1 > claim.display.x1 || claim.data.y1 > claim.display.y1)
        fail(options.picture, "its size is not the one that its header says");
    if (!is_same_scene && !options.json)
        print_result("the scene is another one: hash " + claim.scene_hash + " in the picture, " + hash + " of " +
                     in_quotes(picture.scene.file));
    const std::vector<size_t> pixels = choose_pixels(claim.channels[0].size(), options.pixels);
    std::vector<Difference> differences;
    with_threads(prepared.threads, [&] {
        begin_prepared(prepared, diagnostics);
        const auto renderer = make_renderer(prepared, picture, usual_batch, diagnostics);
        differences = compare(*renderer, prepared, claim, pixels);
    });
    if (options.json) {
        print_result(json_of(options.picture, {claim, picture.scene.file, hash, pixels.size(), differences}));
        return differences.empty() && is_same_scene ? exit_done : exit_failed;
    }
    print_differences(differences);
    const std::string counted =
        format_text("%zu of %zu pixels traced again: ", pixels.size(), claim.channels[0].size());
    if (!differences.empty()) {
        print_result(counted + format_text("%zu differ", differences.size()));
        return exit_failed;
    }
    print_result(counted + "all have the same bits" + (claim.is_half ? ", in 16 bits" : ""));
    if (pixels.size() < claim.channels[0].size())
        print_result(format_text("a picture with 1 %% wrong pixels passes with a chance of %.2g %%",
                                 100 * std::pow(0.99, static_cast<double>(pixels.size()))));
    if (claim.is_denoised) print_result("layer noisy was compared; denoising it was not repeated");
    return is_same_scene ? exit_done : exit_failed;
}

}  // namespace

int run_verify(int argc, char** argv)
{
    const auto options = parse_verify(argc, argv);
    return options ? verify(*options) : exit_done;
}

}  // namespace lancer
