#include "report/page/svg_frame.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "report/page/number_text.h"

namespace lancer {
namespace {

constexpr double width = 760, left = 74, right = 16, top = 40, plot_height = 300;
constexpr double plot_width = width - left - right;
constexpr double row_height = 18, letter_width = 6.7;  // of text of 12 units

std::string number(double x) { return fixed_text(x, 2); }
std::string attribute(const char* name, double x) { return std::string(" ") + name + "=\"" + number(x) + "\""; }

// About how wide a text is.
double text_width(const std::string& text)
{
    const auto letters = std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; });
    return letter_width * static_cast<double>(letters);
}

// The sign of a series, drawn around the origin.
std::string shape_of(size_t i)
{
    static constexpr std::array shapes{"M-4,0a4,4 0 1,0 8,0a4,4 0 1,0 -8,0z",
                                       "M-3.5,-3.5h7v7h-7z",
                                       "M0,-5l5,5l-5,5l-5,-5z",
                                       "M0,-4.5l4.5,8h-9z",
                                       "M0,4.5l4.5,-8h-9z",
                                       "M-5,-1.5h3.5v-3.5h3v3.5h3.5v3h-3.5v3.5h-3v-3.5h-3.5z",
                                       "M-4,-4.5l8,4.5l-8,4.5z"};
    return shapes[i % shapes.size()];
}

}  // namespace

void AxisValues::add(double value)
{
    low_ = any_ ? std::min(low_, value) : value;
    high_ = any_ ? std::max(high_, value) : value;
    any_ = true;
}

void AxisValues::add_range(const Ranged& r)
{
    for (const double end : {r.low, r.high})
        if (fits(scale_, end)) add(end);
}

Axis AxisValues::axis() const
{
    if (any_) return make_axis(scale_, low_, high_);
    return scale_ == Scale::linear ? make_axis(scale_, 0, 1) : make_axis(scale_, 1, 10);
}

std::string series_class(size_t i) { return "c" + std::to_string(i % 10) + (i % 20 < 10 ? "" : " hollow"); }

std::string ranged_text(const Ranged& r)
{
    const std::string value = significant(r.value);
    if (!std::isfinite(r.low) || !std::isfinite(r.high)) return value;
    return value + " [" + significant(r.low) + " .. " + significant(r.high) + "]";
}

SvgFrame::SvgFrame(const PlotLabels& labels, const std::vector<std::string>& legend) : labels_(labels), legend_(legend)
{
}

SvgPoint SvgFrame::at(double x, double y) { return {left + x * plot_width, top + (1 - y) * plot_height}; }

void SvgFrame::element(const std::string& name, const std::string& attributes, const std::string& tip)
{
    body_ += "<" + name + attributes;
    body_ += tip.empty() ? "/>\n" : "><title>" + escape_xml(tip) + "</title></" + name + ">\n";
}

void SvgFrame::label(SvgPoint p, const std::string& classes, const std::string& text, const std::string& attributes)
{
    body_ += "<text class=\"" + classes + "\"" + attribute("x", p.x) + attribute("y", p.y) + attributes + ">" +
             escape_xml(text) + "</text>\n";
}

void SvgFrame::x_ticks(const Axis& axis)
{
    for (const double tick : axis.ticks) {
        const SvgPoint p = at(place(axis, tick), 0);
        element("path", " class=\"grid\" d=\"M" + number(p.x) + "," + number(top) + "v" + number(plot_height) + "\"");
        label({p.x, p.y + 17}, "tick x", round_text(tick));
    }
    below_ = 22;
}

void SvgFrame::x_groups(const std::vector<std::string>& names)
{
    const double room = plot_width / static_cast<double>(std::max<size_t>(names.size(), 1));
    double widest = 0;
    for (const std::string& name : names) widest = std::max(widest, text_width(name));
    const bool slanted = widest > room - 4;
    for (size_t i = 0; i < names.size(); ++i) {
        const SvgPoint p = at((static_cast<double>(i) + 0.5) / static_cast<double>(names.size()), 0);
        const std::string turn = " transform=\"rotate(-35 " + number(p.x) + " " + number(p.y + 12) + ")\"";
        if (slanted)
            label({p.x + 4, p.y + 14}, "tick end", names[i], turn);
        else
            label({p.x, p.y + 17}, "tick x", names[i]);
    }
    below_ = slanted ? 14 + 0.6 * widest : 22;
}

void SvgFrame::y_ticks(const Axis& axis)
{
    for (const double tick : axis.ticks) {
        const SvgPoint p = at(0, place(axis, tick));
        element("path", " class=\"grid\" d=\"M" + number(p.x) + "," + number(p.y) + "h" + number(plot_width) + "\"");
        label({p.x - 6, p.y + 4}, "tick end", round_text(tick));
    }
}

void SvgFrame::marks(const std::vector<PlotMark>& marks, const Axis& axis)
{
    for (const PlotMark& mark : marks) {
        if (!fits(axis.scale, mark.value)) continue;
        const SvgPoint p = at(0, place(axis, mark.value));
        element("path", " class=\"mark\" d=\"M" + number(p.x) + "," + number(p.y) + "h" + number(plot_width) + "\"");
        if (mark.label_left)
            label({left + 4, p.y - 4}, "halo", mark.label);
        else
            label({width - right - 4, p.y - 4}, "end halo", mark.label);
    }
}

void SvgFrame::note(const std::string& text) { notes_.push_back(text); }

void SvgFrame::whisker(double x, double low, double high, const std::string& colour)
{
    const SvgPoint a = at(x, low), b = at(x, high);
    element("path", " class=\"whisker " + colour + "\" d=\"M" + number(a.x - 3) + "," + number(a.y) + "h6m-3,0V" +
                        number(b.y) + "m-3,0h6\"");
}

void SvgFrame::sign(size_t i, SvgPoint p, const std::string& tip)
{
    element("path",
            " class=\"sign " + series_class(i) + "\" transform=\"translate(" + number(p.x) + " " + number(p.y) +
                ")\" d=\"" + shape_of(i) + "\"",
            tip);
}

std::string SvgFrame::text() const
{
    SvgFrame all(labels_, legend_);
    double y = top + plot_height + below_;
    if (!labels_.x.empty()) all.label({left + plot_width / 2, y += 14}, "axis", labels_.x);
    double x = left;
    y += row_height + 4;
    for (size_t i = 0; i < legend_.size(); ++i) {
        const double needed = text_width(legend_[i]) + 34;
        if (x > left && x + needed > width) x = left, y += row_height;
        all.sign(i, {x + 6, y - 4});
        all.label({x + 16, y}, "legend", legend_[i]);
        x += needed;
    }
    for (const std::string& text : notes_) all.label({left, y += row_height}, "note", text);
    all.label({width / 2, 20}, "heading", labels_.title);
    all.label({0, 0}, "axis", labels_.y,
              " transform=\"translate(16 " + number(top + plot_height / 2) + ") rotate(-90)\"");
    const std::string title = escape_xml(labels_.title);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" role=\"img\" aria-label=\"" + title +
           "\" viewBox=\"0 0 " + number(width) + " " + number(y + 12) + "\">\n<title>" + title + "</title>\n<desc>" +
           escape_xml(labels_.description) + "</desc>\n" + body_ + all.body_ + "</svg>\n";
}

}  // namespace lancer
