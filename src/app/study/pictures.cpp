#include "app/study/pictures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/console.h"
#include "app/study/peers.h"
#include "io/image/exr.h"
#include "io/image/png.h"
#include "io/input_text.h"
#include "report/metrics/metrics.h"
#include "report/metrics/worst_blocks.h"
#include "report/page/number_text.h"
#include "report/study/level.h"

namespace lancer {
namespace {

constexpr int32_t block_side = 32;
constexpr size_t most_blocks = 3;

MethodOnScene& entry_of(Study& study, const std::string& scene, const std::string& method)
{
    for (MethodOnScene& e : study.on_scenes)
        if (e.scene == scene && e.method == method) return e;
    MethodOnScene& entry = study.on_scenes.emplace_back();
    entry.scene = scene, entry.method = method;
    return entry;
}

double mean_error(const Image& picture, const Image& reference)
{
    const std::vector<double> errors = relative_squared_errors(picture, reference);
    double total = 0;
    for (const double e : errors) total += e;
    return total / static_cast<double>(errors.size());
}

// Whole stops that bring the mean of a part to where one sees well.
int stops_for(const Image& part)
{
    double total = 0;
    for (const Color& pixel : part.pixels)
        for (const double x : channels(pixel)) total += x / 3;
    const double mean = total / static_cast<double>(part.pixels.size());
    return mean > 0 && std::isfinite(mean)
               ? static_cast<int>(std::lround(std::clamp(std::log2(0.25 / mean), -8.0, 8.0)))
               : 0;
}

// The whole picture, as bright as one sees well; highlights keep their colours.
std::string reference_png(const StudyWork& work, const std::string& scene, const Image& reference)
{
    const std::string path = work.file("references/" + scene + ".png");
    write_png(path, reference, {},
              {.exposure_stops = static_cast<float>(stops_for(reference)), .tonemap = ToneMap::agx});
    return read_input_text(path);
}

}  // namespace

void add_levels(Study& study, const std::string& scene, const LastPictures& pictures, const Reference& reference)
{
    for (const StudyMethod& m : study.methods) {
        const auto found = pictures.find({scene, m.name});
        if (found == pictures.end()) continue;
        // Without seeds all are one picture.
        std::vector<Image> images;
        for (const LastPicture& picture : found->second) {
            Image image = read_exr(picture.path);
            const auto same = [&](const Image& other) { return compare(image, other).differing_pixels == 0; };
            if (std::none_of(images.begin(), images.end(), same)) images.push_back(std::move(image));
        }
        PictureLevel level = level_of(images, reference.halves[0], reference.halves[1]);
        level.scene = scene, level.method = m.name;
        const std::string why = m.peer ? why_other_level(level) : "";
        study.levels.push_back(std::move(level));
        if (why.empty()) continue;
        for (const std::string& name : {m.name, own_name(m.name)}) {
            if (std::none_of(study.methods.begin(), study.methods.end(), [&](const auto& o) { return o.name == name; }))
                continue;
            std::string& said = entry_of(study, scene, name).not_ranked;
            said = said.empty() ? why : said + "; " + why;
        }
    }
}

ScenePictures pictures_of(const StudyWork& work, const Study& study, const std::string& scene,
                          const LastPictures& pictures, const Reference& reference)
{
    struct Shown {
        std::string name, when;
        Image image;
        bool chooses = true;
    };
    const Image mean = mean_of(reference);
    std::vector<Shown> shown{{"reference", "", mean, false}};
    for (const StudyMethod& m : study.methods) {
        const auto found = pictures.find({scene, m.name});
        if (found == pictures.end()) continue;
        const LastPicture& last = found->second.front();
        shown.push_back({m.name, round_text(std::round(last.spp)) + " spp in " + significant(last.seconds) + " s",
                         read_exr(last.path), study.on_scene(scene, m.name).not_ranked.empty()});
    }
    std::vector<const Image*> choosing;
    for (const Shown& s : shown)
        if (s.chooses) choosing.push_back(&s.image);
    ScenePictures result;
    result.scene = scene, result.reference_png = reference_png(work, scene, mean);
    for (const Window& window : worst_blocks(mean, choosing, block_side, most_blocks)) {
        const Image reference_part = part_of(mean, window);
        const int stops = stops_for(reference_part);
        PictureRow& row = result.rows.emplace_back();
        row.caption =
            format_text("%d x %d pixels at (%d, %d)", window.width(), window.height(), window.x0, window.y0) +
            (stops == 0 ? ""
                        : format_text(", shown %d %s %s", std::abs(stops), std::abs(stops) == 1 ? "stop" : "stops",
                                      stops > 0 ? "brighter" : "darker"));
        for (const Shown& s : shown) {
            const Image part = part_of(s.image, window);
            const std::string path =
                work.file(format_text("crops/%s.%d-%d.%s.png", scene.c_str(), window.x0, window.y0, s.name.c_str()));
            write_png(path, part, {}, {.exposure_stops = static_cast<float>(stops)});
            const std::string error = "relMSE " + significant(mean_error(part, reference_part)) + "; " + s.when;
            row.pictures.push_back({s.name, s.when.empty() ? "" : error, read_input_text(path)});
        }
    }
    return result;
}

}  // namespace lancer
