// What all plots have around their data: title, axes with ticks and grid, marks, legend, notes. Used by svg_plot.cpp.
#pragma once

#include <string>
#include <vector>

#include "report/page/svg_plot.h"

namespace lancer {

// Position in the picture, in its units.
struct SvgPoint {
    double x = 0, y = 0;
};

// Collects the values that an axis has to show, and how many cannot be shown.
class AxisValues {
public:
    explicit AxisValues(Scale scale) : scale_(scale) {}
    void add(double value);  // must fit
    // The ends of a range as far as they fit.
    void add_range(const Ranged& r);
    Axis axis() const;  // from 0 to 1 (1 to 10) if there are none

private:
    Scale scale_;
    bool any_ = false;
    double low_ = 0, high_ = 0;
};

// Writes SVG elements into a text.
class SvgFrame {
public:
    SvgFrame(const PlotLabels& labels, const std::vector<std::string>& legend);
    // Where a part of the plot's width (0 left, 1 right) and of its height (0 below, 1 above) stands.
    static SvgPoint at(double x, double y);

    void x_ticks(const Axis& axis);
    void x_groups(const std::vector<std::string>& names);
    void y_ticks(const Axis& axis);
    void marks(const std::vector<PlotMark>& marks, const Axis& axis);
    void note(const std::string& text);
    // An element; its attributes are written as they stand, the tip is escaped. Tips show under the pointer.
    void element(const std::string& name, const std::string& attributes, const std::string& tip = {});
    // From low to high at x, with caps.
    void whisker(double x, double low, double high, const std::string& colour);
    // The sign of series i, where a point is or the legend shows it.
    void sign(size_t i, SvgPoint p, const std::string& tip = {});

    std::string text() const;  // the whole picture

private:
    void label(SvgPoint p, const std::string& classes, const std::string& text, const std::string& attributes = {});

    PlotLabels labels_;
    std::vector<std::string> legend_;
    std::vector<std::string> notes_;
    double below_ = 0;  // height of what stands between the axis and its label
    std::string body_;
};

// The classes that give series i its colour: ten, then the same ten paler.
std::string series_class(size_t i);

// "12.3 [12.0 .. 12.5]"
std::string ranged_text(const Ranged& r);

}  // namespace lancer
