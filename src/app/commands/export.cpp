// lancer export: a scene as other renderers can read it.
#include <deque>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/asset_files.h"
#include "app/commands/commands.h"
#include "app/console.h"
#include "app/options/options.h"
#include "app/prepare.h"
#include "core/names.h"
#include "core/parallel.h"
#include "io/atomic_file.h"
#include "io/image/exr.h"
#include "io/obj/write.h"
#include "io/scene/scene_json.h"

namespace lancer {
namespace {

void make_folder(const std::string& folder)
{
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    if (problem) throw Error(ErrorKind::failed, {folder}, "cannot make this folder: " + problem.message());
}

// A folder that holds the scene's own files may hold others of these names.
void refuse_input_as_output(const SceneDescription& scene, const std::vector<std::string>& outputs)
{
    std::error_code absent;
    for (const std::string& output : outputs)
        for (const std::string& input : input_files(scene))
            if (std::filesystem::equivalent(output, input, absent))
                throw Error(ErrorKind::usage, {}, "--output: " + in_quotes(output) + " would overwrite an input");
}

void write_picture(AtomicFile& file, const ExportedPicture& picture)
{
    const Window window{0, 0, static_cast<int32_t>(picture.width), static_cast<int32_t>(picture.height)};
    const auto fill = [&](int32_t y, std::span<Color> row) {
        for (size_t x = 0; x < row.size(); ++x)
            row[x] = picture.texel(static_cast<uint32_t>(x), static_cast<uint32_t>(y));
    };
    write_exr(file, {window, window, fill}, {}, {.half = picture.half});
}

void write_all(const ExportOptions& options, const Prepared& p, const Scene& scene)
{
    const SceneDescription& d = p.description;
    const ExportedPictures pictures = exported_pictures(scene);
    const auto path_of = [&](const std::string& name) {
        return (std::filesystem::path(options.folder) / name).string();
    };
    std::vector<std::string> meshes, paths;
    for (size_t i = 0; i < d.meshes.size(); ++i) meshes.push_back("mesh_" + std::to_string(i) + ".obj");
    for (const std::string& name : meshes) paths.push_back(path_of(name));
    for (const ExportedPicture& picture : pictures.files) paths.push_back(path_of(picture.name));
    paths.push_back(path_of("scene.json"));
    refuse_input_as_output(d, paths);
    make_folder(options.folder);

    // All are complete before the first takes its name.
    std::deque<AtomicFile> files;
    for (size_t i = 0; i < meshes.size(); ++i)
        write_obj(files.emplace_back(path_of(meshes[i])), *d.meshes[i].data, !scene.shading[i].uvs.empty(),
                  [&](uint32_t triangle) -> std::optional<uint32_t> {
                      const auto& corners = scene.geometry.meshes[i].triangles[triangle];
                      if (corners[0] == corners[1]) return {};  // a copy of another
                      return scene.shading[i].material_of(triangle);
                  });
    for (const ExportedPicture& picture : pictures.files)
        write_picture(files.emplace_back(path_of(picture.name)), picture);
    const std::string text = scene_json(d, scene, p.settings, meshes, pictures);
    files.emplace_back(paths.back()).write(text.data(), text.size());
    for (AtomicFile& file : files) file.finish();
    for (AtomicFile& file : files) file.commit();
}

}  // namespace

int run_export(int argc, char** argv)
{
    const auto options = parse_export(argc, argv);
    if (!options) return exit_done;
    Diagnostics diagnostics;
    Prepared p = load_prepared(options->picture, diagnostics, false);
    std::unique_ptr<const Scene> scene;
    with_threads(p.threads, [&] {
        begin_prepared(p, diagnostics);
        scene = p.scene->finish(diagnostics);
    });
    check_exportable(p.description, *scene, p.settings, diagnostics);
    diagnostics.throw_if_errors();
    for (const auto& warning : diagnostics.warnings()) print_problem(to_string(warning));
    write_all(*options, p, *scene);
    return exit_done;
}

}  // namespace lancer
