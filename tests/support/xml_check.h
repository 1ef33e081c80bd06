// Whether a text is well-formed XML, as far as our pages use it: elements, attributes, entities and a doctype. And the
// elements in it, for tests that look at single ones.
#pragma once

#include <cctype>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace lancer {

struct XmlElement {
    std::string name;
    std::map<std::string, std::string> attributes;
    std::string text;  // what stands directly in it, its entities replaced
    bool has_class(const std::string& word) const
    {
        const auto it = attributes.find("class");
        return it != attributes.end() && (" " + it->second + " ").find(" " + word + " ") != std::string::npos;
    }
};

// Elements in the order of their beginnings. Throws std::runtime_error with the place of the first fault.
class XmlReader {
public:
    explicit XmlReader(std::string_view text) : text_(text) { read(); }
    std::vector<XmlElement> elements;

private:
    [[noreturn]] void fail(const std::string& what) const
    {
        throw std::runtime_error(what + " at: " + std::string(text_.substr(at_, 60)));
    }
    bool ahead(std::string_view s) const { return text_.substr(at_, s.size()) == s; }
    std::string name()
    {
        const size_t begin = at_;
        while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '-')) ++at_;
        if (at_ == begin) fail("no name");
        return std::string(text_.substr(begin, at_ - begin));
    }
    void spaces()
    {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    }
    char letter()
    {
        if (text_[at_] != '&') return text_[at_++];
        static const std::map<std::string_view, char> entities{
            {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&#39;", '\''}};
        for (const auto& [entity, c] : entities) {
            if (!ahead(entity)) continue;
            at_ += entity.size();
            return c;
        }
        fail("an '&' that begins no entity");
    }
    void open_tag()
    {
        ++at_;
        XmlElement element{name(), {}, {}};
        for (spaces(); at_ < text_.size() && text_[at_] != '>' && text_[at_] != '/'; spaces()) {
            const std::string key = name();
            if (!ahead("=\"")) fail("an attribute without a value in quotes");
            at_ += 2;
            std::string value;
            while (at_ < text_.size() && text_[at_] != '"') {
                if (text_[at_] == '<') fail("'<' in an attribute");
                value += letter();
            }
            ++at_;
            if (!element.attributes.emplace(key, value).second) fail("an attribute that is given twice");
        }
        const auto id = element.attributes.find("id");
        if (id != element.attributes.end() && !ids_.insert(id->second).second) fail("an id that is given twice");
        elements.push_back(element);
        if (ahead("/>")) {
            at_ += 2;
        } else if (ahead(">")) {
            ++at_;
            open_.push_back(elements.size() - 1);
        } else {
            fail("a tag without an end");
        }
    }
    void close_tag()
    {
        at_ += 2;
        if (open_.empty() || name() != elements[open_.back()].name || !ahead(">"))
            fail("a tag that closes another one");
        ++at_;
        open_.pop_back();
    }
    void read()
    {
        if (ahead("<!DOCTYPE html>")) at_ += 15;
        while (at_ < text_.size()) {
            if (ahead("</")) {
                close_tag();
            } else if (ahead("<")) {
                if (open_.empty() && !elements.empty()) fail("a second root");
                open_tag();
            } else if (open_.empty()) {
                if (!std::isspace(static_cast<unsigned char>(text_[at_]))) fail("text outside the root");
                ++at_;
            } else {
                elements[open_.back()].text += letter();
            }
        }
        if (!open_.empty()) fail("'" + elements[open_.back()].name + "' is never closed");
        if (elements.empty()) fail("no root");
    }

    std::string_view text_;
    size_t at_ = 0;
    std::vector<size_t> open_;
    std::set<std::string> ids_;
};

inline std::vector<XmlElement> read_xml(std::string_view text) { return XmlReader(text).elements; }

}  // namespace lancer
