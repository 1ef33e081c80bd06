#include "app/options/option_parser.h"

#include <CLI/CLI.hpp>

#include "app/console.h"
#include "app/options/option_values.h"
#include "app/version.h"

namespace lancer {

OptionParser::OptionParser(const std::string& program, const std::string& description, const std::string& footer)
    : app_(std::make_unique<CLI::App>(description, program))
{
    app_->get_formatter()->column_width(32);
    app_->allow_extras();
    app_->footer(footer);
    app_->set_help_flag("-h,--help", "Print this and exit");
    app_->add_flag("--version", version_, "Print the versions of the program and its libraries and exit");
}

OptionParser::~OptionParser() = default;

void OptionParser::argument(const std::string& name, const std::string& help, const Take& take, bool required)
{
    add(name, help, take)->required(required)->option_text(" ");
}

void OptionParser::arguments(const std::string& name, const std::string& help, const Take& take)
{
    add(name, help, take)
        ->required()
        ->option_text(" ")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->expected(1, -1)
        ->allow_extra_args();
}

void OptionParser::value(const std::string& names, const std::string& type, const std::string& help, const Take& take)
{
    add(names, help, take)->option_text(type);
}

void OptionParser::values(const std::string& names, const std::string& type, const std::string& help, const Take& take)
{
    add(names, help, take)->option_text(type)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void OptionParser::flag(const std::string& names, const std::string& help, bool& set)
{
    app_->add_flag(names, set, help);
}

void OptionParser::flag(const std::string& names, const std::string& help, const std::function<void()>& take)
{
    app_->add_flag_callback(names, take, help);
}

void OptionParser::group(const std::string& name) { app_->option_defaults()->group(name); }

bool OptionParser::parse(int argc, char** argv)
{
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
