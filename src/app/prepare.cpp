#include "app/prepare.h"

#include "app/console.h"
#include "app/load_scene.h"

namespace lancer {
namespace {

// Warnings go out even if errors follow: they often tell why.
void print_warnings(const Diagnostics& diagnostics)
{
    for (const auto& warning : diagnostics.warnings()) print_problem(to_string(warning));
}

}  // namespace

Prepared load_prepared(const PictureOptions& options, Diagnostics& diagnostics, bool quiet)
{
    Prepared p;
    try {
        p.description = load_scene(options.scene, options.asset_root, diagnostics);
    } catch (...) {
        print_warnings(diagnostics);
        throw;
    }
    p.settings = resolve_settings(options, p.description.render);
    const std::string added = complete_scene(p.description, double(p.settings.width) / p.settings.height);
    if (!added.empty() && !quiet)
        print_note("added to the scene, as it says nothing about it; to change it, put this into a scene file:\n" +
                   added);
    return p;
}

void build_prepared(Prepared& p, const PictureOptions& options, Diagnostics& diagnostics)
{
    try {
        p.scene = Scene::build(p.description, diagnostics);
    } catch (...) {
        print_warnings(diagnostics);
        throw;
    }
    p.description.meshes.clear();  // the scene has its own copy; two would be held for the whole render
    print_warnings(diagnostics);
    for (const auto& warning : diagnostics.warnings()) p.warnings.push_back(to_string(warning));
    if (options.strict && !p.warnings.empty())
        throw Error(ErrorKind::invalid_input, {options.scene},
                    std::to_string(p.warnings.size()) + " warnings, and --strict allows none");
}

}  // namespace lancer
