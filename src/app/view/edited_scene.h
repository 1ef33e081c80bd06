// A scene that the hand changes: what it is now, and what of its file that makes. Scenes are never changed in place:
// each change makes another description, which a session may still be building while the next one comes.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/load_scene.h"
#include "io/scene/output_table.h"

namespace lancer {

// A number of a material, or a colour.
struct MaterialNumber {
    std::string key;
    std::array<float, 3> value{};
    uint32_t count = 1;         // 1 or 3
    float least = 0, most = 1;  // may be infinite
};

class EditedScene {
public:
    // added: what complete_scene() returned. given: render settings of the command line; opened: resolved.
    EditedScene(SceneChoice choice, std::string added, SceneDescription scene, RenderSettings given,
                RenderSettings opened);

    const std::shared_ptr<const SceneDescription>& scene() const { return scene_; }
    // Counts the changes of all but point and directional lights.
    uint64_t rest() const { return rest_; }

    void move_light(size_t light, Vec3d position);   // point, sphere
    void turn_light(size_t light, Vec3d direction);  // directional
    void set_radius(size_t light, double radius);    // sphere
    void set_power(size_t light, Color power);       // black: it is off
    void turn_sky(size_t light, Vec3d rotate_deg);   // an environment that is a picture
    // Returns its place among the lights; the last one that is said of an environment counts.
    size_t add_light(const LightDescription& light);
    void move_sphere(size_t sphere, Vec3d center);  // that can_move()
    bool can_move(size_t sphere) const;             // not the parts of bubbles
    // The numbers of [material.NAME], or else of the material of a mesh file; empty if there is none of that name.
    std::vector<MaterialNumber> numbers_of(const std::string& material) const;
    void set_number(const std::string& material, const MaterialNumber& number);

    // Where the file is from now on that the scene was opened from.
    void read_from(const std::string& file) { choice_.file = file; }
    // As a scene file that renders the same bits, with this camera. settings: as they are now, of which those that
    // differ from what the scene was opened with are written.
    std::string text(const CameraDescription& camera, const RenderSettings& settings,
                     const OutputDescription& output) const;

private:
    SceneDescription& change();
    LightDescription& light(size_t index);
    std::optional<MaterialDescription> find(const std::string& material) const;
    void set_number_of_mesh(const std::string& material, const MaterialNumber& number);

    SceneChoice choice_;
    std::string added_;
    RenderSettings given_, opened_;
    std::shared_ptr<const SceneDescription> scene_;
    std::shared_ptr<const SceneDescription> as_opened_;
    std::map<std::string, std::string> edits_;  // key of -D: value
    // Of materials of mesh files, by name.
    std::map<std::string, std::vector<MaterialNumber>> mesh_edits_;
    size_t lights_of_file_;  // and of `added`; further ones came by hand
    uint64_t rest_ = 0;
};

}  // namespace lancer
