#include "report/study/page.h"

#include <algorithm>

#include "report/page/number_text.h"
#include "report/page/svg_plot.h"
#include "report/study/json.h"
#include "report/study/ranking.h"
#include "report/study/tables.h"

namespace lancer {
namespace {

std::string marked_name(const StudyMethod& m) { return m.name + (m.biased() ? " (biased)" : ""); }

std::string error_plot(const SceneFigures& f, bool over_time)
{
    const std::string x = over_time ? "seconds of rendering" : "samples per pixel";
    LinePlot plot{{f.scene.name + ": error over " + (over_time ? "time" : "samples"),
                   "Both axes are logarithmic. A line for each method: the median over its seeds of the relative mean "
                   "squared error of the picture, over " +
                       x + "; the area around it holds that median with 95 %.",
                   x, "relMSE"},
                  Scale::logarithmic,
                  Scale::logarithmic,
                  {},
                  {}};
    double least = std::numeric_limits<double>::infinity();
    for (const MethodFigures& m : f.all) {
        PlotSeries series{marked_name(*m.method), {}, Look::band};
        for (const CurvePoint& p : over_time ? m.time : m.samples) {
            series.points.push_back({p.x, {p.median, p.band.low, p.band.high}});
            if (p.median > 0) least = std::min(least, p.median);
        }
        plot.series.push_back(std::move(series));
    }
    // Further down it would only squeeze the curves; the text tells it in any case.
    if (noise_limit(f.scene.reference_noise_relmse) > least / 10)
        plot.marks.push_back(
            {noise_limit(f.scene.reference_noise_relmse), "not ranked below: twice the noise of the reference", true});
    return to_svg(plot);
}

std::vector<Block> reference_blocks(const StudyScene& scene)
{
    std::vector<Block> blocks;
    if (!scene.description.empty()) blocks.push_back(Paragraph{scene.description});
    const std::string reference = scene.reference.empty() ? "not told" : scene.reference;
    const double noise = scene.reference_noise_relmse;
    blocks.push_back(Paragraph{"Reference: " + reference + ". " +
                               (noise > 0 ? "Its own noise is a relMSE of " + significant(noise) +
                                                "; nothing is ranked below " + significant(noise_limit(noise)) +
                                                ", where half of what is measured or more would be that noise."
                                          : "It is taken to be exact.")});
    return blocks;
}

std::vector<Block> remarks(const StudyMethod& method, const MethodOnScene& known)
{
    std::vector<Block> blocks;
    if (!known.left_out.empty())
        blocks.push_back(Paragraph{"Left out: " + method.name + ": " + known.left_out, Tone::bad});
    if (!known.not_ranked.empty()) blocks.push_back(Paragraph{method.name + ": " + known.not_ranked + ".", Tone::bad});
    if (!known.reference.empty())
        blocks.push_back(Paragraph{method.name + ": errors against " + known.reference +
                                   ". Its own noise is a relMSE of " + significant(known.reference_noise_relmse) +
                                   "."});
    return blocks;
}

const ScenePictures* pictures_of(const std::vector<ScenePictures>& pictures, const StudyScene& scene)
{
    const auto own =
        std::find_if(pictures.begin(), pictures.end(), [&](const auto& p) { return p.scene == scene.name; });
    return own == pictures.end() ? nullptr : &*own;
}

// Each scene as its reference shows it.
Gallery references(const Study& study, const std::vector<ScenePictures>& pictures)
{
    Gallery gallery;
    for (const StudyScene& scene : study.scenes)
        if (const ScenePictures* own = pictures_of(pictures, scene); own && !own->reference_png.empty())
            gallery.pictures.push_back({scene.name, scene.description, own->reference_png});
    return gallery;
}

Section scene_section(const Study& study, const StudyScene& scene, const std::vector<ScenePictures>& pictures,
                      size_t number)
{
    SceneFigures figures{study, scene, {}};
    Section section{"Scene: " + scene.name, reference_blocks(scene)};
    for (const StudyMethod& m : study.methods) {
        const MethodOnScene& known = study.on_scene(scene.name, m.name);
        if (known.left_out.empty()) figures.all.push_back(figures_of(study, scene, m));
        for (Block& block : remarks(m, known)) section.blocks.push_back(std::move(block));
    }
    section.blocks.push_back(Plot{error_plot(figures, true)});
    section.blocks.push_back(times_table(figures));
    section.blocks.push_back(speed_up_table(figures));
    section.blocks.push_back(efficiency_table(figures));
    section.blocks.push_back(slopes_table(figures));
    if (Table levels = levels_table(figures); !levels.rows.empty()) section.blocks.push_back(std::move(levels));
    section.blocks.push_back(Plot{error_plot(figures, false)});
    section.blocks.push_back(errors_table(figures));
    section.blocks.push_back(runs_table(figures));
    const ScenePictures* own = pictures_of(pictures, scene);
    if (!own || own->rows.empty()) return section;
    section.blocks.push_back(Paragraph{
        "Where methods are worst, at about equal time, of the first seed: each block by its reference and by each "
        "method. Point at one, or touch it, to see the reference in its place. Blocks are chosen by their error "
        "relative "
        "to that of the whole picture, with the same weight for each method that is compared."});
    for (size_t i = 0; i < own->rows.size(); ++i) {
        PictureRow row = own->rows[i];
        row.id = "crops-" + std::to_string(number) + "-" + std::to_string(i);
        for (Picture& picture : row.pictures)
            for (const StudyMethod& m : study.methods)
                if (m.name == picture.name) picture.name = marked_name(m);
        section.blocks.push_back(std::move(row));
    }
    return section;
}

Section methods_section(const Study& study)
{
    Table table{"", {"method", "what it is", "version", "biases"}, {}};
    for (const StudyMethod& m : study.methods) {
        std::string biases;
        for (const std::string& bias : m.biases) biases += (biases.empty() ? "" : "\n") + bias;
        const std::string role = m.name == study.baseline ? "\nthe baseline" : m.peer ? "\nanother program" : "";
        table.rows.push_back({{m.name + role},
                              {m.description},
                              {m.version.empty() ? "not told" : m.version},
                              {m.biased() ? biases : "none", false, m.biased() ? Tone::bad : Tone::plain}});
    }
    return {
        "Methods and the ledger of their biases",
        {Paragraph{"A bias is what keeps the mean of a method's pictures from the truth, however long it renders. A "
                   "method is ranked only against one with the same biases. Limits of a scene that its reference has "
                   "as well stand with the reference."},
         std::move(table)}};
}

Section machine_section(const Study& study)
{
    Table table{"", {"", ""}, {}};
    for (const auto& [name, value] : study.machine) table.rows.push_back({{name}, {value}});
    if (table.rows.empty()) return {"The machine", {Paragraph{"Not told.", Tone::bad}}};
    return {"The machine", {std::move(table)}};
}

std::vector<Section> failures(const Study& study)
{
    Table table{"", {"scene", "method", "seed", "what went wrong"}, {}};
    for (const StudyRun& run : study.runs)
        if (run.failed)
            table.rows.push_back(
                {{run.scene}, {run.method}, {std::to_string(run.seed), true}, {run.problem, false, Tone::bad}});
    if (table.rows.empty()) return {};
    return {{"Failed runs",
             {Paragraph{"A method of which a run failed is not ranked on that scene.", Tone::bad}, std::move(table)}}};
}

Section reading_section()
{
    return {
        "How to read this",
        {Paragraph{"Errors are of linear radiance, before any tone mapping: relMSE is the mean over pixels and "
                   "channels of (x - r)² / (r² + 0.01). Beside it stands the same without the 0.1 % of pixels that "
                   "are worst, as a few bright pixels can hide what the others do. Seconds are of rendering alone: "
                   "loading, building and writing are not in them."},
         Paragraph{"Figures are medians over seeds. Intervals are of 95 %, by the bootstrap over seeds; ratios "
                   "resample the seeds that both methods have, in pairs. The time to an error is the one from which "
                   "on the error stays there, between two measurements on a line in logarithms; a time that is "
                   "marked as extrapolated follows the slope of the last doublings and is never ranked. Slopes are of "
                   "the last five "
                   "doublings that are above ten times the noise of the reference."},
         Paragraph{
             "Another program writes no log of its errors: it renders pictures of doubling numbers of samples, "
             "each from its beginning, and each is held against the reference as those of lancer are. The time of "
             "one is what that program counts as rendering. A picture that took longer than one of more samples "
             "is left out, in its favour. It stands in the tables a second time, against a reference that it drew "
             "for itself: there only its noise counts, and what its mean may have that is wrong does not. Where "
             "the two differ, the second is in its favour."},
         Paragraph{
             "Exposure and energy: the mean radiance of the last pictures over that of the reference, and the "
             "relMSE of their mean as it would be without noise. Another program whose level differs by more than "
             "2 % beyond doubt is not ranked."},
         Paragraph{"Methods are compared at equal time and at equal error. One is called faster or slower only if "
                   "the interval of the ratio excludes 1, both have at least " +
                   std::to_string(fewest_seeds) +
                   " seeds in common, no run failed, both have the same biases, and the errors are above twice the "
                   "noise of the reference. An efficiency is that at the time beside it; it holds for other times "
                   "only as far as RMSE falls with the slope -0.5. Intervals of 95 % err: of twenty comparisons of "
                   "methods that are equal, one is called faster or slower by chance."}}};
}

}  // namespace

Document make_study_page(const Study& study, const std::vector<ScenePictures>& pictures)
{
    Document page{study.title, {}, {}};
    if (Gallery gallery = references(study, pictures); !gallery.pictures.empty())
        page.opening.push_back(std::move(gallery));
    for (const std::string& reason : study.not_comparable)
        page.opening.push_back(Paragraph{"Not comparable: " + reason + ".", Tone::bad});
    if (study.not_comparable.empty())
        page.opening.push_back(Paragraph{"Comparable: nothing was found that sets these runs apart.", Tone::good});
    page.opening.push_back(overview_table(study));
    page.sections.push_back(methods_section(study));
    for (size_t i = 0; i < study.scenes.size(); ++i)
        page.sections.push_back(scene_section(study, study.scenes[i], pictures, i));
    for (Section& section : failures(study)) page.sections.push_back(std::move(section));
    page.sections.push_back(machine_section(study));
    page.sections.push_back(reading_section());
    page.sections.push_back({"Raw data",
                             {Paragraph{"The whole study stands in this page, in a script element of type "
                                        "application/json."},
                              JsonData{"study", to_json(study)}},
                             true});
    return page;
}

}  // namespace lancer
