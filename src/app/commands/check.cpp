// lancer check: every problem of a scene and its files, one line each, without a picture.
#include <algorithm>
#include <string>
#include <vector>

#include "app/commands/commands.h"
#include "app/console.h"
#include "app/defaults/complete_scene.h"
#include "app/diagnostics_json.h"
#include "app/load_scene.h"
#include "app/options/option_values.h"
#include "app/options/options.h"
#include "app/picture_memory.h"
#include "app/prepare.h"
#include "core/parallel.h"
#include "io/file_name.h"
#include "io/obj/check.h"
#include "report/json_object.h"
#include "scene/check.h"

namespace lancer {
namespace {

class Check {
public:
    explicit Check(const CheckOptions& options) : options_(options) {}

    int execute()
    {
        try {
            run();
        } catch (const Error& e) {
            if (e.kind() != ErrorKind::invalid_input && e.kind() != ErrorKind::missing_input) throw;
            error_lines_ = split(e.what(), '\n');
            code_ = e.kind() == ErrorKind::missing_input ? exit_missing : exit_invalid;
        }
        if (options_.json)
            print_json();
        else
            print_lines();
        return code_ == exit_done && options_.strict && !problems_.warnings().empty() ? exit_invalid : code_;
    }

private:
    void run()
    {
        SceneDescription description = load_scene(options_.scene, problems_, {}, nullptr, true);
        const RenderSettings settings = resolve_settings({}, description.render);
        const unsigned threads = options_.threads.value_or(available_threads());
        for (const std::string& file : mesh_files(description))
            if (mesh_extension_of(file) != ".ply" && !is_gltf(file)) check_obj_text(file, notes_);
        check_description(description, problems_, notes_);
        with_threads(threads, [&] {
            PictureMemory memory = memory_for(options_.memory, threads);
            ImageSource images(threads, memory.ahead);
            serve(memory, images);
            SceneChoice choice = options_.scene;
            choice.ground = false;  // emitters are judged by what is in the files
            complete_scene(description, choice, aspect_of(settings.size), images.source(), memory);
            SceneBuilder scene(description, settings, problems_, images.source(), memory);
            check_texture_coordinates(description, scene.unfinished(), problems_);
            const Renderer renderer(std::move(scene), configure(settings, 1), problems_);
            check_emitters(description, renderer.scene(), renderer.accelerator(), problems_);
            warn_of_hidden_lights(description, settings, renderer, problems_);
            for (const Scene::Note& note : renderer.scene().sheets) notes_.warning(note.where, note.text);
            for (const Scene::Note& note : renderer.scene().divisions) notes_.warning(note.where, note.text);
        });
    }
    static std::vector<std::string> mesh_files(const SceneDescription& scene)
    {
        std::vector<std::string> files;
        for (const MeshDescription& mesh : scene.meshes)
            if (mesh.data->shape.empty() && std::find(files.begin(), files.end(), mesh.data->file) == files.end())
                files.push_back(mesh.data->file);
        return files;
    }
    void print_lines() const
    {
        for (const std::string& line : error_lines_) print_result(line);
        for (const auto& warning : problems_.warnings()) print_result(to_string(warning));
        for (const auto& note : notes_.warnings()) print_result(to_string(note, "note"));
        const auto counted = [](size_t n, const char* what) {
            return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
        };
        print_result(counted(error_lines_.size(), "error") + ", " + counted(problems_.warnings().size(), "warning") +
                     ", " + counted(notes_.warnings().size(), "note"));
    }
    void print_json() const
    {
        JsonObject all("lancer.check/1");
        all.text("scene", options_.scene.file);
        std::vector<JsonObject> errors;
        for (const std::string& line : error_lines_) errors.push_back(error_object(line));
        all.objects("errors", errors);
        all.objects("warnings", warning_objects(problems_));
        all.objects("notes", warning_objects(notes_));
        print_result(all.to_text());
    }

    const CheckOptions& options_;
    Diagnostics problems_, notes_;
    std::vector<std::string> error_lines_;
    int code_ = exit_done;
};

}  // namespace

int run_check(int argc, char** argv)
{
    const auto options = parse_check(argc, argv);
    return options ? Check(*options).execute() : exit_done;
}

}  // namespace lancer
