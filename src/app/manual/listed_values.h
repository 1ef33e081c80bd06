// What a manual or a completion needs to know of a listed option or command.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/options/option_listing.h"

namespace lancer {

// What the value of an option may be.
struct ListedValues {
    std::vector<std::string> words;  // "path", "direct"
    bool files = false, folders = false;
};
// Of its type: what stands in small letters between '|' is a word, FILE a file.
ListedValues values_of(const ListedOption& option);

// "render" of "lancer render".
std::string command_name(const ListedCommand& command);

// "SCENE X Y [SAMPLE]", "PART..."
std::string argument_text(const ListedOption& argument);
// "[OPTION]... SCENE"
std::string synopsis_of(const ListedCommand& command);

// A part of the footer of a help: its heading, "" for a paragraph that has none, and its lines.
struct FooterPart {
    std::string heading, text;
};
// Headings: "Exit codes", "Signals", "Example"; what follows "Example:" or "Examples:" keeps its line feeds.
std::vector<FooterPart> parts_of(const std::string& footer);

// Groups of options in the order in which they appear: arguments, then options without a heading.
struct OptionGroup {
    std::string name;  // "Arguments", "Options" or the heading
    std::vector<const ListedOption*> options;
};
std::vector<OptionGroup> groups_of(const ListedCommand& command);

// With the separator between them.
std::string joined(const std::vector<std::string>& words, std::string_view separator);
std::string replaced(std::string text, std::string_view what, std::string_view by);
// The first line, without its colon or full stop: a short description.
std::string first_line(const std::string& help);

}  // namespace lancer
