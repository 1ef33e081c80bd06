#include "report/html.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "report/html_pictures.h"
#include "report/markdown.h"
#include "report/svg_plot.h"
#include "support/xml_check.h"

namespace lancer {
namespace {

const std::string wild = "</script><b>&\"'|`";

Document everything()
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
    const auto page = read_xml(to_html(everything()));
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
    for (const XmlElement& e : read_xml(to_html(everything()))) {
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
    for (const XmlElement& e : read_xml(to_html(everything()))) {
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

TEST(Html, PicturesStandInThePageAndAreChosenWithoutAScript)
{
    Document document = everything();
    document.sections[0].blocks.push_back(
        PictureFlip{"one", {{"a " + wild, wild, png_of("x")}, {"b", "", png_of("")}}});
    document.sections[1].blocks.push_back(PictureFlip{"two", {{"a", "", png_of("y")}}});
    const std::string text = to_html(document);
    std::vector<XmlElement> images, inputs, labels;
    std::string style;
    for (const XmlElement& e : read_xml(text)) {
        if (e.name == "img") images.push_back(e);
        if (e.name == "input") inputs.push_back(e);
        if (e.name == "label") labels.push_back(e);
        if (e.name == "style") style = e.text;
        if (e.name == "script") {
            EXPECT_EQ(e.attributes.at("type"), "application/json");
        }
    }
    ASSERT_EQ(images.size(), 3u);
    EXPECT_EQ(images[0].attributes.at("alt"), "a " + wild);
    EXPECT_EQ(images[0].attributes.at("src"), "data:image/png;base64," + base64(png_of("x")));
    EXPECT_EQ(images[0].attributes.at("width"), "258");
    EXPECT_EQ(images[0].attributes.at("height"), "3");
    ASSERT_EQ(inputs.size(), 3u);
    ASSERT_EQ(labels.size(), 3u);
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(inputs[i].attributes.at("id"), labels[i].attributes.at("for"));
        EXPECT_EQ(inputs[i].attributes.at("name"), i < 2 ? "one" : "two");
        EXPECT_EQ(inputs[i].attributes.count("checked"), i == 1 ? 0u : 1u);  // one of each
    }
    EXPECT_NE(style.find(".flip input:nth-of-type(2):checked~figure:nth-of-type(2)"), std::string::npos);
    EXPECT_EQ(style.find("nth-of-type(3)"), std::string::npos);
    EXPECT_EQ(to_html(everything()).find(".flip"), std::string::npos);
    EXPECT_EQ(to_markdown({"t", {document.sections[1].blocks}, {}}, 2), "");
}

TEST(Html, RefusesPicturesOfAnotherKind)
{
    for (const std::string& bytes :
         {std::string("GIF89a, and more than twenty-four bytes"), png_of("").substr(0, 23)}) {
        try {
            to_html(Document{"t", {PictureFlip{"p", {{"crop", "", bytes}}}}, {}});
            ADD_FAILURE();
        } catch (const Error& e) {
            EXPECT_STREQ(e.what(), "error: the picture 'crop' is no PNG");
        }
    }
}

TEST(Html, NeedsNothingElse)
{
    const std::string page = to_html(everything());
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
