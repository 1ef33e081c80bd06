// What a command's parser knows of its options, as data: for manual pages and completions (app/manual/).
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lancer {

// An option or an argument.
struct ListedOption {
    std::vector<std::string> names;  // "-o", "--output"; of an argument one in capitals
    std::string type{};              // of its value, as the help shows it: "FILE", "a|b|c"; empty: it takes none
    std::string help;
    std::string group;                   // its heading; empty before the first
    std::vector<std::string> endings{};  // of the files that it takes; none: any
    std::vector<std::string> list{};     // the words of a value that is a list with commas
    bool is_argument = false;
    bool is_required = false;  // of an argument
    bool is_repeatable = false;
};

struct ListedCommand {
    std::string program;  // "lancer render"
    std::string description;
    std::string footer;  // exit codes and examples, as the help has them
    std::vector<ListedOption> options;
};

// While one lives, parsers put what they know into a listing in place of parsing, and their parse() is false.
class OptionListener {
public:
    explicit OptionListener(ListedCommand& listing);
    ~OptionListener();
    OptionListener(const OptionListener&) = delete;
    OptionListener& operator=(const OptionListener&) = delete;
};

}  // namespace lancer
