#include "report/page/html_pictures.h"

#include <algorithm>
#include <cstdint>

#include "core/error.h"
#include "report/page/number_text.h"

namespace lancer {
namespace {

uint32_t byte_at(const std::string& bytes, size_t i) { return static_cast<uint8_t>(bytes[i]); }

// A PNG begins with its signature and the chunk IHDR, which begins with width and height, big end first.
std::pair<uint32_t, uint32_t> size_of(const Picture& picture)
{
    static constexpr std::string_view signature("\x89PNG\r\n\x1a\n", 8);
    const std::string& png = picture.png;
    if (png.size() < 24 || png.compare(0, signature.size(), signature) != 0 || png.compare(12, 4, "IHDR") != 0)
        throw Error(ErrorKind::failed, {}, "the picture '" + picture.name + "' is no PNG");
    const auto number = [&](size_t i) {
        return byte_at(png, i) << 24 | byte_at(png, i + 1) << 16 | byte_at(png, i + 2) << 8 | byte_at(png, i + 3);
    };
    return {number(16), number(20)};
}

// How large one pixel is shown: small parts as large as others.
uint32_t enlarged(uint32_t pixels, uint32_t width, uint32_t shown) { return pixels * std::max(shown / width, 1u); }

constexpr uint32_t row_width = 200, pair_width = 384;  // on the screen, at most

std::string image(const Picture& picture, uint32_t shown, const std::string& name)
{
    const auto [width, height] = size_of(picture);
    return "<img width=\"" + std::to_string(enlarged(width, width, shown)) + "\" height=\"" +
           std::to_string(enlarged(height, width, shown)) + "\" alt=\"" + name + "\" src=\"data:image/png;base64," +
           base64(picture.png) + "\"/>";
}

std::string figure(const Picture& picture, const Picture* reference)
{
    const std::string name = escape_xml(picture.name);
    std::string images = image(picture, row_width, name);
    if (reference)
        images =
            "<span class=\"swap\" tabindex=\"0\">" + images + image(*reference, row_width, "the reference") + "</span>";
    return "<figure>" + images + "<figcaption>" + name +
           (picture.caption.empty() ? "" : "<br/>" + escape_xml(picture.caption)) + "</figcaption></figure>\n";
}

// One of the two sides of the slider: radio buttons, as they are siblings of what they show.
std::string choices(const PictureRow& row, const std::string& side, size_t chosen)
{
    const std::string group = escape_xml(row.id) + "-" + side;
    std::string out = "<span class=\"side\">" + side + "</span>";
    for (size_t i = 0; i < row.pictures.size(); ++i) {
        const std::string own = group + "-" + std::to_string(i);
        out += "<input type=\"radio\" class=\"" + side + std::to_string(i) + "\" name=\"" + group + "\" id=\"" + own +
               "\"" + (i == chosen ? " checked=\"checked\"" : "") + "/><label for=\"" + own + "\">" +
               escape_xml(row.pictures[i].name) + "</label>\n";
    }
    return out + "<br/>\n";
}

std::string layer(const PictureRow& row, const std::string& side)
{
    std::string out = "<div class=\"" + side + "\">";
    for (size_t i = 0; i < row.pictures.size(); ++i)
        out += "<span class=\"" + side + std::to_string(i) + "\">" +
               image(row.pictures[i], pair_width, escape_xml(row.pictures[i].name)) + "</span>";
    return out + "</div>";
}

std::string slider(const PictureRow& row)
{
    return "<div class=\"pair\">\n" + choices(row, "left", 1) + choices(row, "right", 0) + "<div class=\"view\">" +
           layer(row, "right") + layer(row, "left") +
           "</div>\n<input type=\"range\" min=\"0\" max=\"100\" value=\"50\" aria-label=\"where left ends and right "
           "begins\" "
           "oninput=\"this.parentNode.querySelector('div.left').style.width=this.value+'%'\"/>\n</div>\n";
}

bool has_gallery(const std::vector<Block>& blocks)
{
    return std::any_of(blocks.begin(), blocks.end(),
                       [](const Block& block) { return std::holds_alternative<Gallery>(block); });
}

constexpr const char* gallery_style =
    ".gallery{display:flex;flex-wrap:wrap;gap:.8em;margin:1em 0}\n"
    ".gallery figure{margin:0;width:256px}.gallery img{display:block;width:100%;height:auto;border-radius:3px}\n"
    ".gallery figcaption{font-size:.8em;padding-top:.25em}.gallery b{display:block}\n";

size_t longest(const std::vector<Block>& blocks)
{
    size_t most = 0;
    for (const Block& block : blocks)
        if (const auto* row = std::get_if<PictureRow>(&block)) most = std::max(most, row->pictures.size());
    return most;
}

}  // namespace

std::string pictures_html(const PictureRow& row)
{
    std::string figures;
    for (const Picture& p : row.pictures)
        figures += figure(p, &p == row.pictures.data() ? nullptr : row.pictures.data());
    return "<div class=\"pictures\">\n<p>" + escape_xml(row.caption) + "</p>\n<div class=\"row\">\n" + figures +
           "</div>\n" + (row.pictures.size() > 1 ? slider(row) : "") + "</div>\n";
}

std::string gallery_html(const Gallery& gallery)
{
    std::string figures;
    for (const Picture& p : gallery.pictures) {
        const std::string name = escape_xml(p.name);
        figures += "<figure>" + image(p, 0, name) + "<figcaption><b>" + name + "</b>" + escape_xml(p.caption) +
                   "</figcaption></figure>\n";
    }
    return "<div class=\"gallery\">\n" + figures + "</div>\n";
}

std::string pictures_style(const Document& document)
{
    size_t most = longest(document.opening);
    bool galleries = has_gallery(document.opening);
    for (const Section& section : document.sections) {
        most = std::max(most, longest(section.blocks));
        galleries = galleries || has_gallery(section.blocks);
    }
    const std::string of_galleries = galleries ? gallery_style : "";
    if (most == 0) return of_galleries;
    std::string shown;
    for (size_t i = 0; i < most; ++i)
        for (const char* side : {"left", "right"}) {
            const std::string name = side + std::to_string(i);
            shown += (shown.empty() ? "" : ",") + std::string("input.") + name + ":checked~.view span." + name;
        }
    return of_galleries +
           ".pictures img{display:block;max-width:none;image-rendering:pixelated}\n"
           ".row figure{display:inline-block;vertical-align:top;margin:.3em .6em .6em 0}\n"
           ".row figcaption{font-size:.8em;max-width:200px}\n"
           ".swap{display:block;position:relative;cursor:pointer}\n"
           ".swap img+img{position:absolute;left:0;top:0;visibility:hidden}\n"
           ".swap:hover img+img,.swap:focus img+img{visibility:visible}\n"
           ".pair label{margin-right:1em;cursor:pointer}.pair input:checked+label{font-weight:600}\n"
           ".side{display:inline-block;width:3.5em}\n"
           ".view{display:inline-block;position:relative;margin-top:.4em}\n"
           ".view div.left{position:absolute;left:0;top:0;width:50%;overflow:hidden;border-right:1px solid #fff}\n"
           ".view span{display:none}" +
           shown +
           "{display:block}\n"
           ".pair input[type=range]{display:block;width:384px;max-width:100%;margin:.3em 0}\n"
           "@media print{.pair{display:none}}\n";
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
