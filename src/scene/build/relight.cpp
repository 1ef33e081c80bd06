#include "scene/build/relight.h"

#include <type_traits>
#include <variant>

#include "scene/alpha_test.h"
#include "scene/build/light_group.h"
#include "scene/build/light_table.h"
#include "scene/build/planar_mirrors.h"
#include "scene/through_glass.h"

namespace lancer {
namespace {

template <class... L>
void list_types(const SceneDescription& d, Scene& scene, Diagnostics& diagnostics,
                std::type_identity<std::variant<L...>>)
{
    const auto add = [&]<class Of>(std::type_identity<Of>) {
        for (const auto& l : d.lights)
            if (l.type == Of::type && !is_black(l.power)) {
                scene.delta_lights.push_back(Of::make(l, scene.normalisation));
                scene.light_groups.of_delta.push_back(light_group(scene, l.group, l.where, diagnostics));
            }
    };
    (add(std::type_identity<L>{}), ...);
}

// What list_delta_lights() and list_lights() fill.
void forget_lights(Scene& scene)
{
    scene.delta_lights.clear();
    scene.light_groups.of_delta.clear();
    scene.lights = {};
    scene.sphere_light.clear(), scene.mesh_first_light.clear(), scene.instance_first_light.clear();
    scene.environment_light = Scene::none;
    scene.mirrors.clear(), scene.instance_mirror_of.clear();
    for (MeshShading& mesh : scene.shading) mesh.mirror_of.clear();
}

}  // namespace

void list_delta_lights(const SceneDescription& description, Scene& scene, Diagnostics& diagnostics)
{
    list_types(description, scene, diagnostics, std::type_identity<DeltaLight>{});
}

void list_lights(Scene& scene)
{
    build_light_table(scene);
    scene.passes_glass = lights_pass_glass(scene);
    find_planar_mirrors(scene);
}

std::unique_ptr<const Scene> relit(const Scene& scene, const SceneDescription& description, Diagnostics& diagnostics)
{
    auto other = std::make_unique<Scene>(scene);
    bind_alpha_test(*other);
    forget_lights(*other);
    list_delta_lights(description, *other, diagnostics);
    list_lights(*other);
    return other;
}

}  // namespace lancer
