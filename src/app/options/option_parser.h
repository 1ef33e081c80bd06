// The options of one command, and the help that tells of them. Every value comes as text and is turned into what it
// means by a function that throws Error, so that messages are our own. option_parser.cpp alone knows CLI11.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/options/option_listing.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace lancer {

class OptionParser {
public:
    using Take = std::function<void(const std::string&)>;

    // program: as one calls it, "lancer render". footer: the end of the help.
    OptionParser(const std::string& program, const std::string& description, const std::string& footer);
    ~OptionParser();
    OptionParser(const OptionParser&) = delete;
    OptionParser& operator=(const OptionParser&) = delete;

    // By its place, in the order of the calls.
    void argument(const std::string& name, const std::string& help, const Take& take, bool required = true);
    // The last argument: one or more.
    void arguments(const std::string& name, const std::string& help, const Take& take);
    // The last one counts. type: what the help shows for the value.
    void value(const std::string& names, const std::string& type, const std::string& help, const Take& take);
    // Each one counts.
    void values(const std::string& names, const std::string& type, const std::string& help, const Take& take);
    void flag(const std::string& names, const std::string& help, bool& set);
    void flag(const std::string& names, const std::string& help, const std::function<void()>& take);
    // The heading of the options that follow.
    void group(const std::string& name);
    // For completions, of the option or argument before: the endings of its files (app/options/file_kinds.h), or the
    // words that its value lists with commas.
    void takes_files(std::string_view endings);
    void takes_list(std::vector<std::string> words);

    // False if help or version was asked for and printed, or a listing (OptionListener). Throws Error (usage).
    bool parse(int argc, char** argv);
    // The same of words that are no command line of this process.
    bool parse(std::vector<std::string> words);
    // Whether it has an option of this long name: "--size".
    bool knows(const std::string& name) const;
    // After it: the options that were given, by their long names where they have one; arguments are none.
    std::vector<std::string> given() const;

private:
    CLI::Option* add(const std::string& names, const std::string& help, const Take& take);
    static bool print_version();
    void check_extras() const;
    ListedOption& note(const std::string& names, const std::string& type, const std::string& help);

    std::unique_ptr<CLI::App> app_;
    bool version_ = false;
    std::string group_;
    ListedCommand listing_;
};

}  // namespace lancer
