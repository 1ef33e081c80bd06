// lancer options: the tables of render settings and of the bias ledger, as docs/ has them; manual and completions.
#include <filesystem>
#include <string>

#include "app/commands/commands.h"
#include "app/console.h"
#include "app/manual/manual.h"
#include "app/options/options.h"
#include "io/atomic_file.h"
#include "render/bias_ledger.h"
#include "scene/description/render_options.h"

namespace lancer {
namespace {

std::string in_code(std::string_view text) { return "`" + std::string(text) + "`"; }

struct Typed {
    std::string type, range;
};

// What a scene file may say, for a reader.
struct TypeOf {
    Typed operator()(const SwitchField&) const { return {"boolean", ""}; }
    Typed operator()(const SizeField&) const
    {
        return {"two integers", "each 1 to " + std::to_string(max_picture_side) + ", at most " +
                                    std::to_string(max_picture_pixels) + " in all"};
    }
    Typed operator()(const ChoiceField& field) const
    {
        std::string names;
        for (const std::string_view name : field.names) names += (names.empty() ? "" : ", ") + in_code(name);
        return {"string", names};
    }
    template <class T>
    Typed operator()(const NumberField<T>& field) const
    {
        return {std::integral<T> ? "integer" : "number", text(field.least) + " to " + text(field.most)};
    }

private:
    static std::string text(double x) { return shortest(x); }
    template <std::integral T>
    static std::string text(T x)
    {
        return std::to_string(x);
    }
};

void print_render_options()
{
    print_result("| key | type | range | default | unit | meaning |\n|---|---|---|---|---|---|");
    for (const RenderOption& option : render_options()) {
        const auto [type, range] = std::visit(TypeOf{}, option.field);
        print_result("| " + in_code(option.name) + " | " + type + " | " + range + " | " +
                     in_code(value_text({}, option)) + " | " + std::string(option.unit) + " | " +
                     std::string(option.help) + " |");
    }
}

void print_biases()
{
    print_result("| entry | when | what it does |\n|---|---|---|");
    for (const LedgerEntry& e : all_ledger_entries())
        print_result("| " + in_code(e.entry) + " | " + e.when + " | " + e.effect + " |");
}

void write_pages(const std::filesystem::path& folder)
{
    for (const ManualFile& file : manual_files()) {
        const std::filesystem::path path = folder / file.path;
        std::error_code problem;
        std::filesystem::create_directories(path.parent_path(), problem);
        write_text(path, file.text);
    }
}

}  // namespace

int run_options(int argc, char** argv)
{
    const auto options = parse_options(argc, argv);
    if (!options) return exit_done;
    if (!options->pages.empty())
        write_pages(options->pages);
    else if (options->biases)
        print_biases();
    else
        print_render_options();
    return exit_done;
}

}  // namespace lancer
