#include "report/page/svg_plot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "report/page/number_text.h"
#include "report/page/svg_frame.h"

namespace lancer {
namespace {

template <class Series>
std::vector<std::string> names_of(const std::vector<Series>& series)
{
    std::vector<std::string> names(series.size());
    std::transform(series.begin(), series.end(), names.begin(), [](const Series& s) { return s.name; });
    return names;
}

void note_omitted(SvgFrame& frame, size_t count)
{
    if (count == 0) return;
    frame.note(std::to_string(count) + (count == 1 ? " value is" : " values are") +
               " left out: not finite, or not positive on a logarithmic axis.");
}

void add_marks(AxisValues& values, const std::vector<PlotMark>& marks, Scale scale)
{
    for (const PlotMark& mark : marks)
        if (fits(scale, mark.value)) values.add(mark.value);
}

// The part of a range that an axis can show; nothing if there is none.
bool shown_range(const Axis& axis, const Ranged& r, double& low, double& high)
{
    if (!fits(Scale::linear, r.low) || !fits(axis.scale, r.high)) return false;
    low = fits(axis.scale, r.low) ? place(axis, r.low) : 0;
    high = place(axis, r.high);
    return true;
}

std::string coordinates(SvgPoint p) { return fixed_text(p.x, 2) + "," + fixed_text(p.y, 2); }

struct Plane {
    Axis x, y;
    SvgPoint at(double px, double py) const { return SvgFrame::at(place(x, px), place(y, py)); }
};

void draw_line(SvgFrame& frame, const Plane& plane, const std::vector<PlotPoint>& points, const std::string& colour)
{
    std::string path;
    for (const PlotPoint& p : points) path += (path.empty() ? "M" : "L") + coordinates(plane.at(p.x, p.y.value));
    if (points.size() > 1) frame.element("path", " class=\"line " + colour + "\" d=\"" + path + "\"");
}

void draw_band(SvgFrame& frame, const Plane& plane, const std::vector<PlotPoint>& points, const std::string& colour)
{
    std::string above, below;
    double low = 0, high = 0;
    for (const PlotPoint& p : points) {
        if (!shown_range(plane.y, p.y, low, high)) low = high = place(plane.y, p.y.value);
        const double x = place(plane.x, p.x);
        above += (above.empty() ? "M" : "L") + coordinates(SvgFrame::at(x, high));
        below.insert(0, "L" + coordinates(SvgFrame::at(x, low)));
    }
    if (points.size() > 1) frame.element("path", " class=\"band " + colour + "\" d=\"" + above + below + "z\"");
}

void draw_points(SvgFrame& frame, const Plane& plane, const PlotSeries& series, size_t number,
                 const std::vector<PlotPoint>& points)
{
    double low = 0, high = 0;
    for (const PlotPoint& p : points) {
        if (series.look != Look::band && shown_range(plane.y, p.y, low, high))
            frame.whisker(place(plane.x, p.x), low, high, series_class(number));
        frame.sign(number, plane.at(p.x, p.y.value), series.name + ": " + significant(p.x) + ", " + ranged_text(p.y));
    }
}

// How much of a group's width its bars take.
constexpr double group_fill = 0.84;

void draw_bar(SvgFrame& frame, const Axis& axis, double base, const Ranged& bar, double left, double width,
              size_t number, const std::string& tip)
{
    const double end = place(axis, bar.value);
    const SvgPoint a = SvgFrame::at(left, std::max(base, end)), b = SvgFrame::at(left + width, std::min(base, end));
    frame.element("rect",
                  " class=\"bar " + series_class(number) + "\" x=\"" + fixed_text(a.x, 2) + "\" y=\"" +
                      fixed_text(a.y, 2) + "\" width=\"" + fixed_text(b.x - a.x, 2) + "\" height=\"" +
                      fixed_text(b.y - a.y, 2) + "\"",
                  tip);
    double low = 0, high = 0;
    if (shown_range(axis, bar, low, high)) frame.whisker(left + width / 2, low, high, "over");
}

}  // namespace

std::string to_svg(const LinePlot& plot)
{
    AxisValues xs(plot.x_scale), ys(plot.y_scale);
    std::vector<std::vector<PlotPoint>> kept(plot.series.size());
    size_t omitted = 0;
    for (size_t i = 0; i < plot.series.size(); ++i) {
        for (const PlotPoint& p : plot.series[i].points) {
            if (!fits(plot.x_scale, p.x) || !fits(plot.y_scale, p.y.value)) {
                ++omitted;
                continue;
            }
            xs.add(p.x), ys.add(p.y.value), ys.add_range(p.y);
            kept[i].push_back(p);
        }
    }
    add_marks(ys, plot.marks, plot.y_scale);
    SvgFrame frame(plot.labels, names_of(plot.series));
    const Plane plane{xs.axis(), ys.axis()};
    frame.x_ticks(plane.x);
    frame.y_ticks(plane.y);
    for (size_t i = 0; i < kept.size(); ++i)
        if (plot.series[i].look == Look::band) draw_band(frame, plane, kept[i], series_class(i));
    for (size_t i = 0; i < kept.size(); ++i) {
        if (plot.series[i].look != Look::points) draw_line(frame, plane, kept[i], series_class(i));
        draw_points(frame, plane, plot.series[i], i, kept[i]);
    }
    frame.marks(plot.marks, plane.y);
    note_omitted(frame, omitted);
    return frame.text();
}

std::string to_svg(const BarPlot& plot)
{
    AxisValues ys(plot.y_scale);
    if (fits(plot.y_scale, plot.base)) ys.add(plot.base);
    add_marks(ys, plot.marks, plot.y_scale);
    size_t omitted = 0;
    for (const BarSeries& s : plot.series) {
        for (const auto& bar : s.bars) {
            if (!bar) continue;
            if (fits(plot.y_scale, bar->value))
                ys.add(bar->value), ys.add_range(*bar);
            else
                ++omitted;
        }
    }
    SvgFrame frame(plot.labels, names_of(plot.series));
    const Axis axis = ys.axis();
    const double base = fits(plot.y_scale, plot.base) ? place(axis, plot.base) : 0;
    frame.y_ticks(axis);
    frame.x_groups(plot.groups);
    const double group_width = 1.0 / static_cast<double>(std::max<size_t>(plot.groups.size(), 1));
    const double width = group_fill * group_width / static_cast<double>(std::max<size_t>(plot.series.size(), 1));
    for (size_t i = 0; i < plot.series.size(); ++i) {
        for (size_t g = 0; g < std::min(plot.groups.size(), plot.series[i].bars.size()); ++g) {
            const auto& bar = plot.series[i].bars[g];
            if (!bar || !fits(plot.y_scale, bar->value)) continue;
            const double left = (static_cast<double>(g) + (1 - group_fill) / 2) * group_width;
            draw_bar(frame, axis, base, *bar, left + static_cast<double>(i) * width, width, i,
                     plot.series[i].name + ", " + plot.groups[g] + ": " + ranged_text(*bar));
        }
    }
    frame.marks(plot.marks, axis);
    note_omitted(frame, omitted);
    return frame.text();
}

std::string plot_style()
{
    static constexpr std::array light{"#0072b2", "#d55e00", "#009e73", "#aa3377", "#56b4e9",
                                      "#e69f00", "#6a51a3", "#8c564b", "#777777", "#222222"};
    static constexpr std::array dark{"#4ea6e6", "#ff8a47", "#2fc79a", "#e377b5", "#9bd8ff",
                                     "#ffc04d", "#ab95ea", "#c99a8f", "#aaaaaa", "#eeeeee"};
    const auto colours = [](const auto& list) {
        std::string text;
        for (size_t i = 0; i < list.size(); ++i) text += ".plot ." + series_class(i) + "{color:" + list[i] + "}";
        return text + "\n";
    };
    return ".plot{display:block;width:100%;max-width:860px;height:auto;font:12px system-ui,sans-serif}\n"
           ".plot text{fill:#333}\n"
           ".plot .heading{font-size:15px;font-weight:600;text-anchor:middle}\n"
           ".plot .axis,.plot .tick.x{text-anchor:middle}\n"
           ".plot .end{text-anchor:end}\n"
           ".plot .note{font-style:italic}\n"
           ".plot .halo{paint-order:stroke;stroke:#fff;stroke-width:3px}\n"
           ".plot .grid{stroke:#ddd}\n"
           ".plot .mark{stroke:#333;stroke-dasharray:5 3}\n"
           ".plot .line,.plot .whisker{fill:none;stroke:currentColor;stroke-width:1.6}\n"
           ".plot .over{color:#222;stroke-width:1}\n"
           ".plot .bar,.plot .sign,.plot .band{fill:currentColor}\n"
           ".plot .band{fill-opacity:.22}\n"
           ".plot .hollow{fill-opacity:.4;stroke:currentColor}\n" +
           colours(light) +
           "@media screen and (prefers-color-scheme:dark){\n"
           ".plot text{fill:#ccc}\n"
           ".plot .halo{stroke:#16181b}\n"
           ".plot .grid{stroke:#3a3a3a}\n"
           ".plot .mark{stroke:#ccc}\n"
           ".plot .over{color:#ccc}\n" +
           colours(dark) + "}\n";
}

}  // namespace lancer
