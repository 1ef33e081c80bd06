#include "report/page/svg_plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "report/page/number_text.h"
#include "support/xml_check.h"

namespace lancer {
namespace {

// Where the ticks with these words stand: across for axis x (class "x"), else up.
std::map<std::string, double> tick_places(const std::vector<XmlElement>& svg, bool x_axis)
{
    std::map<std::string, double> places;
    for (const XmlElement& e : svg) {
        if (e.name == "text" && e.has_class("tick") && e.has_class("x") == x_axis)
            places[e.text] = std::atof(e.attributes.at(x_axis ? "x" : "y").c_str()) - (x_axis ? 0 : 4);
    }
    return places;
}

// Middles of the signs of data, in their order; those of the legend have no tip.
std::vector<std::pair<double, double>> sign_places(const std::vector<XmlElement>& svg, const std::string& colour)
{
    std::vector<std::pair<double, double>> places;
    for (size_t i = 0; i + 1 < svg.size(); ++i) {
        if (!svg[i].has_class("sign") || !svg[i].has_class(colour) || svg[i + 1].name != "title") continue;
        double x = 0, y = 0;
        EXPECT_EQ(std::sscanf(svg[i].attributes.at("transform").c_str(), "translate(%lf %lf)", &x, &y), 2);
        places.emplace_back(x, y);
    }
    return places;
}

size_t count_class(const std::vector<XmlElement>& svg, const std::string& word)
{
    size_t count = 0;
    for (const XmlElement& e : svg) count += e.has_class(word);
    return count;
}

std::vector<std::string> notes(const std::vector<XmlElement>& svg)
{
    std::vector<std::string> found;
    for (const XmlElement& e : svg)
        if (e.has_class("note")) found.push_back(e.text);
    return found;
}

TEST(SvgPlot, PointsStandWhereTheTicksSay)
{
    LinePlot plot{{"t", "d", "x", "y"}, Scale::logarithmic, Scale::linear, {}, {}};
    plot.series.push_back({"a", {{1e3, {0}}, {1e5, {5}}, {1e7, {2}}}, Look::points});
    const auto svg = read_xml(to_svg(plot));
    const auto x = tick_places(svg, true), y = tick_places(svg, false);
    const auto signs = sign_places(svg, "c0");
    ASSERT_EQ(signs.size(), 3u);
    EXPECT_NEAR(signs[0].first, x.at("1000"), 0.011);
    EXPECT_NEAR(signs[1].first, x.at("10⁵"), 0.011);
    EXPECT_NEAR(signs[2].first, x.at("10⁷"), 0.011);
    EXPECT_NEAR(signs[0].second, y.at("0"), 0.011);
    EXPECT_NEAR(signs[1].second, y.at("5"), 0.011);
    EXPECT_NEAR(signs[2].second, y.at("0") + (y.at("5") - y.at("0")) * 2 / 5, 0.011);
    EXPECT_LT(y.at("5"), y.at("0"));  // up
    EXPECT_LT(x.at("1000"), x.at("10⁷"));
}

TEST(SvgPlot, LinesGoThroughTheirPoints)
{
    LinePlot plot{{"t", "d", "x", "y"}, Scale::linear, Scale::logarithmic, {}, {}};
    plot.series.push_back({"a", {{0, {1}}, {3, {30}}, {4, {100}}}, Look::line});
    const auto svg = read_xml(to_svg(plot));
    const auto signs = sign_places(svg, "c0");
    std::string path;
    for (const auto& [x, y] : signs) path += (path.empty() ? "M" : "L") + fixed_text(x, 2) + "," + fixed_text(y, 2);
    std::vector<std::string> lines;
    for (const XmlElement& e : svg)
        if (e.has_class("line")) lines.push_back(e.attributes.at("d"));
    EXPECT_EQ(lines, std::vector<std::string>{path});
    EXPECT_EQ(signs.size(), 3u);
}

TEST(SvgPlot, BarsReachFromZeroToTheirValue)
{
    BarPlot plot{{"t", "d", "x", "y"}, Scale::linear, {"p", "q"}, {}, {}};
    plot.series.push_back({"a", {Ranged{10, 8, 12}, Ranged{-5}}});
    plot.series.push_back({"b", {std::nullopt, Ranged{2}}});
    const auto svg = read_xml(to_svg(plot));
    const auto y = tick_places(svg, false);
    const double zero = y.at("0"), unit = (zero - y.at("10")) / 10;
    std::vector<std::pair<double, double>> bars;  // top, bottom
    std::vector<double> lefts;
    for (const XmlElement& e : svg) {
        if (!e.has_class("bar")) continue;
        const double top = std::atof(e.attributes.at("y").c_str());
        bars.emplace_back(top, top + std::atof(e.attributes.at("height").c_str()));
        lefts.push_back(std::atof(e.attributes.at("x").c_str()));
    }
    ASSERT_EQ(bars.size(), 3u);
    EXPECT_NEAR(bars[0].first, zero - 10 * unit, 0.03);
    EXPECT_NEAR(bars[0].second, zero, 0.03);
    EXPECT_NEAR(bars[1].first, zero, 0.03);
    EXPECT_NEAR(bars[1].second, zero + 5 * unit, 0.03);
    EXPECT_NEAR(bars[2].first, zero - 2 * unit, 0.03);
    EXPECT_LT(lefts[0], lefts[1]);
    EXPECT_LT(lefts[1], lefts[2]);
    EXPECT_EQ(count_class(svg, "whisker"), 1u);
    for (const XmlElement& e : svg) {
        if (!e.has_class("whisker")) continue;
        double x = 0, low = 0, high = 0;
        ASSERT_EQ(std::sscanf(e.attributes.at("d").c_str(), "M%lf,%lfh6m-3,0V%lfm-3,0h6", &x, &low, &high), 3);
        EXPECT_NEAR(low, zero - 8 * unit, 0.03);
        EXPECT_NEAR(high, zero - 12 * unit, 0.03);
    }
    EXPECT_TRUE(notes(svg).empty());  // a gap is no fault
}

TEST(SvgPlot, BarsOfALogarithmicAxisBeginAtTheirBase)
{
    const auto bar = [](double base) {
        BarPlot plot{{"t", "d", "x", "y"}, Scale::logarithmic, {"p"}, {{"a", {Ranged{0.1}}}}, {}, base};
        const auto svg = read_xml(to_svg(plot));
        for (const XmlElement& e : svg) {
            if (!e.has_class("bar")) continue;
            const double top = std::atof(e.attributes.at("y").c_str());
            return std::tuple(tick_places(svg, false), top, top + std::atof(e.attributes.at("height").c_str()));
        }
        throw std::runtime_error("no bar");
    };
    const auto [y, top, bottom] = bar(1);
    EXPECT_NEAR(top, y.at("1"), 0.03);
    EXPECT_NEAR(bottom, y.at("0.1"), 0.03);
    const auto [none_y, none_top, none_bottom] = bar(0);
    EXPECT_NEAR(none_bottom, none_y.at("0.1"), 0.03);  // the low end
}

TEST(SvgPlot, MarksStandAtTheirValue)
{
    BarPlot plot{{"t", "d", "x", "y"}, Scale::linear, {"p"}, {{"a", {Ranged{0.5}}}}, {{1, "equal"}}};
    const auto svg = read_xml(to_svg(plot));
    ASSERT_EQ(count_class(svg, "mark"), 1u);
    for (const XmlElement& e : svg) {
        if (!e.has_class("mark")) continue;
        double x = 0, y = 0;
        ASSERT_EQ(std::sscanf(e.attributes.at("d").c_str(), "M%lf,%lf", &x, &y), 2);
        EXPECT_NEAR(y, tick_places(svg, false).at("1"), 0.011);
    }
}

TEST(SvgPlot, LabelsOfMarksStandOnTheSideThatIsAskedFor)
{
    const LinePlot plot{{"t", "d", "x", "y"}, {}, {}, {{"a", {{1, {2}}}}}, {{1, "there"}, {1.5, "here", true}}};
    std::map<std::string, double> x;
    for (const XmlElement& e : read_xml(to_svg(plot))) {
        if (!e.has_class("halo")) continue;
        x[e.text] = std::atof(e.attributes.at("x").c_str());
        EXPECT_EQ(e.has_class("end"), e.text == "there");
    }
    EXPECT_LT(x.at("here") + 600, x.at("there"));
}

TEST(SvgPlot, EmptyPlotsAreWellFormed)
{
    EXPECT_NO_THROW(read_xml(to_svg(LinePlot{})));
    EXPECT_NO_THROW(read_xml(to_svg(BarPlot{})));
    LinePlot plot{{"t", "d", "x", "y"}, Scale::logarithmic, Scale::logarithmic, {{"none", {}, Look::line}}, {}};
    EXPECT_NO_THROW(read_xml(to_svg(plot)));
    BarPlot bars{{"t", "d", "x", "y"}, Scale::logarithmic, {"g"}, {{"none", {}}}, {}};
    EXPECT_NO_THROW(read_xml(to_svg(bars)));
}

TEST(SvgPlot, WhatIsNoNumberIsLeftOutAndSaid)
{
    LinePlot plot{{"t", "d", "x", "y"}, Scale::logarithmic, Scale::linear, {}, {}};
    plot.series.push_back(
        {"a", {{1, {NAN}}, {10, {INFINITY}}, {0, {1}}, {2, {3}}, {5, {4, -INFINITY, 5}}}, Look::line});
    const std::string text = to_svg(plot);
    const auto svg = read_xml(text);
    EXPECT_EQ(sign_places(svg, "c0").size(), 2u);
    EXPECT_EQ(notes(svg),
              (std::vector<std::string>{"3 values are left out: not finite, or not positive on a logarithmic axis."}));
    BarPlot bars{{"t", "d", "x", "y"}, Scale::linear, {"g", "h"}, {{"a", {Ranged{NAN, 1, 2}, Ranged{1, NAN, 2}}}}, {}};
    const auto bar_svg = read_xml(to_svg(bars));
    EXPECT_EQ(count_class(bar_svg, "bar"), 1u);
    EXPECT_EQ(notes(bar_svg),
              (std::vector<std::string>{"1 value is left out: not finite, or not positive on a logarithmic axis."}));
    for (const std::string& s : {text, to_svg(bars)}) {
        for (const XmlElement& e : read_xml(s)) {
            for (const auto& [key, value] : e.attributes) {
                EXPECT_EQ(value.find("nan"), std::string::npos) << key << "=" << value;
                EXPECT_EQ(value.find("inf"), std::string::npos) << key << "=" << value;
            }
        }
    }
}

TEST(SvgPlot, NamesAreEscapedAndTold)
{
    const std::string wild = "<script>&\"'";
    LinePlot plot{
        {wild, wild, wild, wild}, Scale::linear, Scale::linear, {{wild, {{1, {2}}}, Look::band}}, {{1, wild}}};
    const auto svg = read_xml(to_svg(plot));
    EXPECT_EQ(svg[0].name, "svg");
    EXPECT_EQ(svg[0].attributes.at("role"), "img");
    EXPECT_EQ(svg[0].attributes.at("aria-label"), wild);
    EXPECT_EQ(svg[1].name, "title");
    EXPECT_EQ(svg[2].name, "desc");
    EXPECT_EQ(svg[2].text, wild);
    for (const XmlElement& e : svg) EXPECT_NE(e.name, "script");
    BarPlot bars{{wild, wild, wild, wild}, Scale::linear, {wild}, {{wild, {Ranged{1}}}}, {{1, wild}}};
    EXPECT_EQ(read_xml(to_svg(bars))[0].attributes.at("aria-label"), wild);
}

TEST(SvgPlot, EverySeriesHasItsColourAndStyle)
{
    LinePlot plot{{"t", "d", "x", "y"}, Scale::linear, Scale::linear, {}, {}};
    for (int i = 0; i < 13; ++i) plot.series.push_back({"series " + std::to_string(i), {{1.0 * i, {2}}}, Look::line});
    const std::string style = plot_style();
    for (const XmlElement& e : read_xml(to_svg(plot))) {
        if (!e.has_class("sign")) continue;
        std::istringstream words(e.attributes.at("class"));
        for (std::string word; words >> word;) EXPECT_NE(style.find("." + word), std::string::npos) << word;
    }
}

}  // namespace
}  // namespace lancer
