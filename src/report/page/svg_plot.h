// Plots as inline SVG for pages: curves and points with ranges, and groups of bars with whiskers. They say what they
// show to readers that do not see them (title and description), tell series apart by shape as well as by colour, and
// get their colours from plot_style(), for light and for dark pages. What cannot be drawn (NaN, infinities, zero on a
// logarithmic axis) is left out, and a line below the plot says so.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "report/page/plot_axis.h"

namespace lancer {

// A value and what it ranges over; without a range, low and high are NaN.
struct Ranged {
    double value = std::numeric_limits<double>::quiet_NaN();
    double low = std::numeric_limits<double>::quiet_NaN(), high = std::numeric_limits<double>::quiet_NaN();
};

// A horizontal line, such as a mark to reach.
struct PlotMark {
    double value = 0;
    std::string label;
    bool label_left = false;  // for plots whose data is to the right
};

struct PlotPoint {
    double x = 0;
    Ranged y;
};
enum class Look { points, line, band };  // a line has its points; a band draws the ranges as an area, not as whiskers
struct PlotSeries {
    std::string name;
    std::vector<PlotPoint> points;
    Look look = Look::line;
};
struct PlotLabels {
    std::string title, description, x, y;
};
struct LinePlot {
    PlotLabels labels;
    Scale x_scale = Scale::linear, y_scale = Scale::linear;
    std::vector<PlotSeries> series;
    std::vector<PlotMark> marks;
};

struct BarSeries {
    std::string name;
    std::vector<std::optional<Ranged>> bars;  // of each group, in their order; nothing is a gap
};
struct BarPlot {
    PlotLabels labels;
    Scale y_scale = Scale::linear;
    std::vector<std::string> groups;
    std::vector<BarSeries> series;
    std::vector<PlotMark> marks;
    double base = 0;  // where bars begin; the low end of a logarithmic axis that has no such value
};

std::string to_svg(const LinePlot& plot);
std::string to_svg(const BarPlot& plot);

// The CSS that the plots of a page share.
std::string plot_style();

}  // namespace lancer
