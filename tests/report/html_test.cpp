#include "report/page/html.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bench/report/markdown.h"
#include "core/error.h"
#include "report/page/html_pictures.h"
#include "report/page/svg_plot.h"
#include "support/xml_check.h"

namespace lancer {
namespace {

const std::string wild = "</script><b>&\"'|`";

Document full_document()
{
    Document document{"Title " + wild, {Paragraph{wild, Tone::bad}}, {}};
    Section section{"Speed " + wild, {}};
    section.blocks.push_back(
        Table{"Rays " + wild, {"who", "Mrays/s"}, {{{wild}, {"12.3", true, Tone::good}}, {{"b"}}}});
    section.blocks.push_back(Plot{to_svg(LinePlot{{wild, wild, "x", "y"}, {}, {}, {}, {}})});
    section.blocks.push_back(JsonData{"data", nlohmann::json{{wild, {1, 2}}}.dump()});
    document.sections.push_back(section);
    document.sections.push_back({"Empty", {}});
    return document;
}

TEST(Html, IsWellFormedWithWhateverText)
{
    const auto page = read_xml(to_html(full_document()));
    EXPECT_EQ(page[0].name, "html");
    std::vector<std::string> headings, links;
    for (const XmlElement& e : page) {
        if (e.name == "h2") headings.push_back("#" + e.attributes.at("id"));
        if (e.name == "a") links.push_back(e.attributes.at("href"));
    }
    EXPECT_EQ(headings.size(), 2u);
    EXPECT_EQ(links, headings);
}

TEST(Html, ShowsTheTextsAsTheyAre)
{
    std::map<std::string, std::string> text;
    size_t cells = 0;
    for (const XmlElement& e : read_xml(to_html(full_document()))) {
        if (!text.count(e.name)) text[e.name] = e.text;
        cells += e.name == "td";
        if (e.text == "12.3") {
            EXPECT_TRUE(e.has_class("number") && e.has_class("good"));
        }
    }
    EXPECT_EQ(text.at("h1"), "Title " + wild);
    EXPECT_EQ(text.at("p"), wild);
    EXPECT_EQ(text.at("caption"), "Rays " + wild);
    EXPECT_EQ(text.at("td"), wild);
    EXPECT_EQ(cells, 4u);  // the short row is filled up
}

TEST(Html, LinesOfACellAreBroken)
{
    const Document document{"Title", {Table{"", {"a"}, {{{"x\n<y>"}}}}}, {}};
    EXPECT_NE(to_html(document).find("<td>x<br/>&lt;y&gt;</td>"), std::string::npos);
    EXPECT_NE(to_markdown(document, 3).find("| x<br>\\<y> |"), std::string::npos);
}

TEST(Html, KeepsTheData)
{
    for (const XmlElement& e : read_xml(to_html(full_document()))) {
        if (e.name != "script") continue;
        EXPECT_EQ(e.attributes.at("type"), "application/json");
        EXPECT_EQ(nlohmann::json::parse(e.text), (nlohmann::json{{wild, {1, 2}}}));
    }
    const std::string json = json_for_html(R"({"a":"<!--<script>&amp;"})");
    EXPECT_EQ(json.find_first_of("<>&"), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(json)["a"], "<!--<script>&amp;");
}

// As much of a PNG as a page looks at.
std::string png_of(const std::string& rest)
{
    return std::string("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\1\2\0\0\0\3", 24) + rest;
}

TEST(Html, Base64OfTheStandard)
{
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(Html, PicturesStandInThePageSideBySideAndUnderASlider)
{
    Document document = full_document();
    document.sections[0].blocks.push_back(
        PictureRow{"one", wild, {{"a " + wild, "", png_of("x")}, {"b", wild, png_of("y")}, {"c", "", png_of("z")}}});
    document.sections[1].blocks.push_back(PictureRow{"two", "", {{"a", "", png_of("y")}}});
    const std::string text = to_html(document);
    std::vector<XmlElement> images, radios, labels, ranges;
    std::string style;
    size_t swaps = 0;
    for (const XmlElement& e : read_xml(text)) {
        if (e.name == "img") images.push_back(e);
        if (e.name == "input") (e.attributes.at("type") == "radio" ? radios : ranges).push_back(e);
        if (e.name == "label") labels.push_back(e);
        if (e.name == "style") style = e.text;
        swaps += e.has_class("swap");
        if (e.name == "script") {
            EXPECT_EQ(e.attributes.at("type"), "application/json");
        }
    }
    ASSERT_EQ(images.size(), 3u + 2 + 6 + 1);
    EXPECT_EQ(swaps, 2u);
    EXPECT_EQ(images[0].attributes.at("alt"), "a " + wild);
    EXPECT_EQ(images[0].attributes.at("src"), "data:image/png;base64," + base64(png_of("x")));
    EXPECT_EQ(images[0].attributes.at("width"), "258");
    EXPECT_EQ(images[0].attributes.at("height"), "3");
    // Over the second lies the first.
    EXPECT_EQ(images[1].attributes.at("src"), "data:image/png;base64," + base64(png_of("y")));
    EXPECT_EQ(images[2].attributes.at("src"), images[0].attributes.at("src"));
    ASSERT_EQ(ranges.size(), 1u);
    ASSERT_EQ(radios.size(), 6u);
    ASSERT_EQ(labels.size(), 6u);
    std::map<std::string, size_t> checked;
    for (size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(radios[i].attributes.at("id"), labels[i].attributes.at("for"));
        checked[radios[i].attributes.at("name")] += radios[i].attributes.count("checked");
        const std::string own = radios[i].attributes.at("class");
        EXPECT_NE(style.find("input." + own + ":checked~.view span." + own), std::string::npos);
    }
    EXPECT_EQ(checked, (std::map<std::string, size_t>{{"one-left", 1}, {"one-right", 1}}));
    EXPECT_EQ(to_html(full_document()).find(".swap"), std::string::npos);
    EXPECT_EQ(to_markdown({"t", {document.sections[1].blocks}, {}}, 2), "");
}

TEST(Html, GalleriesShowEachPictureOnceWithItsNameAndCaption)
{
    const Gallery gallery{{{"a " + wild, wild, png_of("x")}, {"b", "", png_of("y")}}};
    const std::string text = to_html(Document{"t", {gallery}, {{"s", {Paragraph{"p"}}}}});
    std::vector<XmlElement> images;
    std::vector<std::string> captions;
    std::string style;
    for (const XmlElement& e : read_xml(text)) {
        if (e.name == "img") images.push_back(e);
        if (e.name == "figcaption") captions.push_back(e.text);
        if (e.name == "style") style = e.text;
    }
    ASSERT_EQ(images.size(), 2u);
    EXPECT_EQ(images[0].attributes.at("alt"), "a " + wild);
    EXPECT_EQ(images[1].attributes.at("src"), "data:image/png;base64," + base64(png_of("y")));
    ASSERT_EQ(captions.size(), 2u);
    EXPECT_NE(captions[0].find(wild), std::string::npos);
    // Without rows of crops nothing of theirs is in the style, and a page without galleries has nothing of these.
    EXPECT_NE(style.find(".gallery"), std::string::npos);
    EXPECT_EQ(style.find(".swap"), std::string::npos);
    EXPECT_EQ(to_html(full_document()).find(".gallery"), std::string::npos);
    EXPECT_EQ(to_markdown({"t", {gallery}, {}}, 2), "");
}

TEST(Html, SmallPicturesAreShownLarge)
{
    const std::string small("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\x20\0\0\0\x10", 24);
    for (const XmlElement& e : read_xml(to_html(Document{"t", {PictureRow{"p", "", {{"crop", "", small}}}}, {}})))
        if (e.name == "img") {
            EXPECT_EQ(e.attributes.at("width"), "192");
            EXPECT_EQ(e.attributes.at("height"), "96");
        }
}

TEST(Html, RefusesPicturesOfAnotherKind)
{
    for (const std::string& bytes :
         {std::string("GIF89a, and more than twenty-four bytes"), png_of("").substr(0, 23)}) {
        try {
            to_html(Document{"t", {PictureRow{"p", "", {{"crop", "", bytes}}}}, {}});
            ADD_FAILURE();
        } catch (const Error& e) {
            EXPECT_STREQ(e.what(), "error: the picture 'crop' is no PNG");
        }
    }
}

TEST(Html, NeedsNothingElse)
{
    const std::string page = to_html(full_document());
    for (const XmlElement& e : read_xml(page)) {
        EXPECT_NE(e.name, "link");
        EXPECT_NE(e.name, "img");
        EXPECT_EQ(e.attributes.count("src"), 0u);
        for (const auto& [key, value] : e.attributes)
            EXPECT_TRUE(key == "xmlns" || value.find("://") == std::string::npos) << value;
        if (e.name == "style") {
            EXPECT_EQ(e.text.find("url("), std::string::npos);
            EXPECT_EQ(e.text.find("@import"), std::string::npos);
            EXPECT_NE(e.text.find("@media print"), std::string::npos);
            EXPECT_NE(e.text.find("prefers-color-scheme:dark"), std::string::npos);
        }
    }
}

TEST(Markdown, TablesAndWordsWithoutPlotsAndData)
{
    Document document{"Title", {Paragraph{"a|b <i>"}}, {}};
    document.sections.push_back(
        {"Speed", {Table{"Rays", {"who", "Mrays/s"}, {{{"x_y|z"}, {"12.3", true}}, {{"b"}}}}, Plot{"<svg/>"}}});
    document.sections.push_back({"Raw", {JsonData{"data", "{}"}}});
    document.sections.push_back({"Long", {Table{"", {"a"}, {{{"b"}}}}}, true});
    EXPECT_EQ(to_markdown(document, 3),
              "a\\|b \\<i>\n\n"
              "### Speed\n\n"
              "Rays\n\n"
              "| who | Mrays/s |\n"
              "|---|--:|\n"
              "| x\\_y\\|z | 12.3 |\n"
              "| b |  |\n\n");
}

}  // namespace
}  // namespace lancer
