// The meshes to measure: our own, made by formulas or from scenes/, the shared ones where they are, and files that the
// user names.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/program.h"
#include "scene/description/description.h"

namespace lancer::bench {

// A pinhole camera with y up.
CameraDescription camera_at(Vec3d position, Vec3d target, double fov_deg);

// A room of the shared scenes, seen from where there is something to see.
struct SharedRoom {
    std::string name, file;
    CameraDescription camera;
};
std::vector<SharedRoom> shared_rooms();

struct MeshChoice {
    std::string name;
    std::function<SceneDescription()> load;  // with a camera and light; throws Error
};

// All that the options want. A file of --mesh is there, else Error (missing_input).
std::vector<MeshChoice> choose_meshes(const Options& options);

// The folder of scenes that are not the project's: $LANCER_SHARED/scenes, else ../shared/scenes beside the project;
// empty if there is none. Throws Error (missing_input) if the variable names one that is not there.
std::string shared_scenes();
// A file in it, unpacked into the cache folder if only its .xz is there; empty if neither is.
std::string shared_file(const std::string& name, const std::string& cache);
// A scene in it with what lies beside it, materials and pictures: what is packed and what is not come together in the
// cache folder. Empty if it is not there.
std::string shared_scene(const std::string& name, const std::string& cache);

}  // namespace lancer::bench
