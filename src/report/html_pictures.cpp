#include "report/html_pictures.h"

#include <algorithm>
#include <cstdint>

#include "core/error.h"
#include "report/number_text.h"

namespace lancer {
namespace {

uint32_t byte_at(const std::string& bytes, size_t i) { return static_cast<uint8_t>(bytes[i]); }

// Width and height as attributes, so that the page does not jump while it loads. A PNG begins with its signature and
// the chunk IHDR, which begins with both, big end first.
std::string size_of(const Picture& picture)
{
    static constexpr std::string_view signature("\x89PNG\r\n\x1a\n", 8);
    const std::string& png = picture.png;
    if (png.size() < 24 || png.compare(0, signature.size(), signature) != 0 || png.compare(12, 4, "IHDR") != 0)
        throw Error(ErrorKind::failed, {}, "the picture '" + picture.name + "' is no PNG");
    const auto number = [&](size_t i) {
        return std::to_string(byte_at(png, i) << 24 | byte_at(png, i + 1) << 16 | byte_at(png, i + 2) << 8 |
                              byte_at(png, i + 3));
    };
    return " width=\"" + number(16) + "\" height=\"" + number(20) + "\"";
}

size_t longest(const std::vector<Block>& blocks)
{
    size_t most = 0;
    for (const Block& block : blocks)
        if (const auto* flip = std::get_if<PictureFlip>(&block)) most = std::max(most, flip->pictures.size());
    return most;
}

}  // namespace

std::string flip_html(const PictureFlip& flip)
{
    const std::string id = escape_xml(flip.id);
    std::string choices, figures;
    for (size_t i = 0; i < flip.pictures.size(); ++i) {
        const Picture& p = flip.pictures[i];
        const std::string name = escape_xml(p.name), own_id = id + "-" + std::to_string(i);
        choices += "<input type=\"radio\" name=\"" + id + "\" id=\"" + own_id + "\"" +
                   (i == 0 ? " checked=\"checked\"" : "") + "/><label for=\"" + own_id + "\">" + name + "</label>\n";
        figures += "<figure><img" + size_of(p) + " alt=\"" + name + "\" src=\"data:image/png;base64," + base64(p.png) +
                   "\"/>\n<figcaption>" + name + (p.caption.empty() ? "" : ": " + escape_xml(p.caption)) +
                   "</figcaption></figure>\n";
    }
    return "<div class=\"flip\">\n" + choices + figures + "</div>\n";
}

std::string flip_style(const Document& document)
{
    size_t most = longest(document.opening);
    for (const Section& section : document.sections) most = std::max(most, longest(section.blocks));
    if (most == 0) return "";
    std::string shown;
    for (size_t i = 1; i <= most; ++i) {
        const std::string nth = ":nth-of-type(" + std::to_string(i) + ")";
        shown += (i > 1 ? "," : "") + std::string(".flip input") + nth + ":checked~figure" + nth;
    }
    return ".flip{margin:1em 0}.flip label{margin-right:1em;cursor:pointer}\n"
           ".flip input:checked+label{font-weight:600}\n"
           ".flip figure{margin:.5em 0}\n"
           ".flip img{display:block;max-width:100%;min-width:min(100%,400px);height:auto;image-rendering:pixelated}\n"
           "@media screen{.flip figure{display:none}" +
           shown +
           "{display:block}}\n"
           "@media print{.flip input,.flip label{display:none}}\n";
}

std::string base64(const std::string& bytes)
{
    static constexpr const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const size_t left = std::min<size_t>(bytes.size() - i, 3);
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < left ? byte_at(bytes, i + k) : 0);
        for (size_t k = 0; k < 4; ++k) out += k <= left ? letters[bits >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

}  // namespace lancer
