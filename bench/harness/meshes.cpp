#include "harness/meshes.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "app/console.h"
#include "harness/generate.h"
#include "harness/stage.h"

namespace lancer::bench {
namespace {

namespace fs = std::filesystem;

struct SharedMesh {
    std::string name, file;
    std::optional<CameraDescription> camera = {};  // else it is fitted
};

std::vector<SharedMesh> shared_meshes()
{
    std::vector<SharedMesh> all{
        {"bunny", "meshes/stanford-bunny.obj"}, {"armadillo", "meshes/armadillo.obj"}, {"ogre", "meshes/ogre.obj"}};
    for (const SharedRoom& room : shared_rooms()) all.push_back({room.name, room.file, room.camera});
    return all;
}

SceneDescription load_grey(const std::string& file, const std::optional<CameraDescription>& camera = {})
{
    return describe_mesh(*load_description(file).meshes.at(0).data, camera);
}

// A temporary name first: who looks meanwhile finds all of it or nothing.
void unpack(const std::string& from, const std::string& to)
{
    fs::create_directories(fs::path(to).parent_path());
    const std::string temporary = to + ".tmp." + std::to_string(getpid());
    const std::string command = "xz -dc " + in_shell_quotes(from) + " > " + in_shell_quotes(temporary);
    const int status = std::system(command.c_str());
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        fs::remove(temporary);
        throw Error(ErrorKind::failed, {from}, "could not be unpacked by xz");
    }
    fs::rename(temporary, to);
}

}  // namespace

CameraDescription camera_at(Vec3d position, Vec3d target, double fov_deg)
{
    CameraDescription c;
    c.position = position, c.target = target, c.fov_deg = fov_deg;
    return c;
}

std::vector<SharedRoom> shared_rooms()
{
    return {{"sponza", "sponza/sponza.obj", camera_at({-2, 10, -35}, {-2, 18, 30}, 75)},
            {"country-kitchen", "country-kitchen/country-kitchen.obj",
             camera_at({1.211, 1.805, 3.852}, {0.773, 1.763, 2.954}, 60)}};
}

std::string shared_scenes()
{
    const char* named = std::getenv("LANCER_SHARED");
    const fs::path folder = named ? fs::path(named) : fs::path(LANCER_SOURCE_DIR) / "../shared";
    if (fs::is_directory(folder / "scenes")) return folder / "scenes";
    if (named) throw Error(ErrorKind::missing_input, {(folder / "scenes").string()}, "no such folder ($LANCER_SHARED)");
    return {};
}

std::string shared_file(const std::string& name, const std::string& cache)
{
    const std::string folder = shared_scenes();
    if (folder.empty()) return {};
    const fs::path plain = fs::path(folder) / name;
    if (fs::exists(plain)) return plain;
    const std::string packed = plain.string() + ".xz";
    if (!fs::exists(packed)) return {};
    const fs::path unpacked = fs::path(cache) / plain.filename();
    if (!fs::exists(unpacked)) unpack(packed, unpacked);
    return unpacked;
}

std::string shared_scene(const std::string& name, const std::string& cache)
{
    const std::string file = shared_file(name, cache);
    if (file.empty()) return {};
    const fs::path from = (fs::path(shared_scenes()) / name).parent_path();
    const fs::path to = fs::path(cache) / "scenes" / from.filename(), scene = to / fs::path(name).filename();
    if (fs::exists(scene)) return scene;
    fs::create_directories(to);
    for (const auto& entry : fs::directory_iterator(from))
        if (entry.path().extension() != ".xz")
            fs::copy(entry.path(), to / entry.path().filename(),
                     fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    fs::copy_file(file, scene, fs::copy_options::overwrite_existing);  // last: where it is, all is
    return scene;
}

std::vector<MeshChoice> choose_meshes(const Options& options)
{
    std::vector<MeshChoice> all;
    const auto add = [&](const std::string& name, std::function<SceneDescription()> load) {
        if (options.wants(name)) all.push_back({name, std::move(load)});
    };
    add("sphere", [] { return describe_mesh(*make_displaced_sphere(100'000)); });
    add("room", [] { return describe_mesh(*make_room(200'000), camera_at({0.9, 0.4, 0.95}, {-0.4, -0.2, -0.5}, 70)); });
    // Those that need not be seen every time have to be asked for.
    const auto add_more = [&](const std::string& name, std::function<SceneDescription()> load) {
        if (options.full || !options.only.empty()) add(name, std::move(load));
    };
    add_more("terrain", [] { return describe_mesh(*make_terrain(200'000)); });
    add_more("shell", [] { return load_grey(LANCER_SOURCE_DIR "/scenes/meshes/shell.obj"); });
    for (const SharedMesh& mesh : shared_meshes()) {
        if (!options.wants(mesh.name)) continue;
        const std::string file = shared_file(mesh.file, options.cache);
        if (!file.empty()) add(mesh.name, [file, camera = mesh.camera] { return load_grey(file, camera); });
    }
    for (const std::string& file : options.meshes) {
        if (!fs::exists(file)) throw Error(ErrorKind::missing_input, {file}, "no such file");
        all.push_back({fs::path(file).stem(), [file] { return load_grey(file); }});
    }
    return all;
}

}  // namespace lancer::bench
