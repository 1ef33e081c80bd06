#include "app/options/option_parser.h"

#include <CLI/CLI.hpp>

#include "app/console.h"
#include "app/options/option_values.h"
#include "app/version.h"

namespace lancer {
namespace {

const char* const help_text = "Print this and exit";
const char* const version_help = "Print the versions of the program and its libraries and exit";

ListedCommand* listened = nullptr;

}  // namespace

OptionListener::OptionListener(ListedCommand& listing) { listened = &listing; }
OptionListener::~OptionListener() { listened = nullptr; }

OptionParser::OptionParser(const std::string& program, const std::string& description, const std::string& footer)
    : app_(std::make_unique<CLI::App>(description, program)), listing_{program, description, footer, {}}
{
    app_->get_formatter()->column_width(32);
    app_->allow_extras();
    app_->footer(footer);
    app_->set_help_flag("-h,--help", help_text);
    app_->add_flag("--version", version_, version_help);
    note("-h,--help", "", help_text);
    note("--version", "", version_help);
}

OptionParser::~OptionParser() = default;

void OptionParser::argument(const std::string& name, const std::string& help, const Take& take, bool required)
{
    add(name, help, take)->required(required)->option_text(" ");
    ListedOption& noted = note(name, name, help);
    noted.is_argument = true;
    noted.is_required = required;
}

void OptionParser::arguments(const std::string& name, const std::string& help, const Take& take)
{
    add(name, help, take)
        ->required()
        ->option_text(" ")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->expected(1, -1)
        ->allow_extra_args();
    ListedOption& noted = note(name, name, help);
    noted.is_argument = noted.is_required = noted.is_repeatable = true;
}

void OptionParser::value(const std::string& names, const std::string& type, const std::string& help, const Take& take)
{
    add(names, help, take)->option_text(type);
    note(names, type, help);
}

void OptionParser::values(const std::string& names, const std::string& type, const std::string& help, const Take& take)
{
    add(names, help, take)->option_text(type)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    note(names, type, help).is_repeatable = true;
}

void OptionParser::flag(const std::string& names, const std::string& help, bool& set)
{
    app_->add_flag(names, set, help);
    note(names, "", help);
}

void OptionParser::flag(const std::string& names, const std::string& help, const std::function<void()>& take)
{
    app_->add_flag_callback(names, take, help);
    note(names, "", help);
}

void OptionParser::group(const std::string& name)
{
    app_->option_defaults()->group(name);
    group_ = name;
}

void OptionParser::takes_files(std::string_view endings)
{
    listing_.options.back().endings = split(std::string(endings), ' ');
}

void OptionParser::takes_list(std::vector<std::string> words) { listing_.options.back().list = std::move(words); }

bool OptionParser::parse(int argc, char** argv)
{
    if (listened) {
        *listened = listing_;
        return false;
    }
    try {
        app_->parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        print_result(app_->help());
        return false;
    } catch (const CLI::ParseError& e) {
        if (version_) return print_version();
        check_extras();
        fail_usage(std::string(e.what()) + "; see " + app_->get_name() + " --help");
    }
    if (version_) return print_version();
    check_extras();
    return true;
}

bool OptionParser::parse(std::vector<std::string> words)
{
    std::string program = app_->get_name();
    std::vector<char*> pointers{program.data()};
    for (std::string& word : words) pointers.push_back(word.data());
    return parse(static_cast<int>(pointers.size()), pointers.data());
}

bool OptionParser::knows(const std::string& name) const { return app_->get_option_no_throw(name) != nullptr; }

std::vector<std::string> OptionParser::given() const
{
    std::vector<std::string> names;
    for (const CLI::Option* option : app_->get_options())
        if (option->count() > 0 && !option->get_positional()) names.push_back(option->get_name());
    return names;
}

CLI::Option* OptionParser::add(const std::string& names, const std::string& help, const Take& take)
{
    const auto all = [take](const CLI::results_t& texts) {
        for (const std::string& text : texts) take(text);
        return true;
    };
    return app_->add_option(names, all, help)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

ListedOption& OptionParser::note(const std::string& names, const std::string& type, const std::string& help)
{
    return listing_.options.emplace_back(
        ListedOption{.names = split(names, ','), .type = type, .help = help, .group = group_});
}

bool OptionParser::print_version()
{
    print_result(version_text());
    return false;
}

void OptionParser::check_extras() const
{
    std::vector<std::string> known;
    for (const CLI::Option* option : app_->get_options())
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    for (const std::string& extra : app_->remaining()) {
        if (extra == "--") continue;  // what follows it are arguments, also with a '-' in front
        if (!extra.starts_with('-')) fail_usage("unexpected argument " + in_quotes(extra));
        const std::string name = extra.substr(0, extra.find('='));
        const auto meant = nearest(name, known);
        fail_usage("unknown option " + in_quotes(name) + (meant ? "; did you mean " + in_quotes(*meant) + "?" : "") +
                   "; see " + app_->get_name() + " --help");
    }
}

}  // namespace lancer
