#include "app/view/edited_scene.h"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "app/console.h"
#include "app/defaults/toml_text.h"
#include "app/view/camera_moves.h"
#include "app/write_scene.h"
#include "scene/build/overrides.h"
#include "scene/description/render_options.h"

namespace lancer {
namespace {

// Floats are written as the doubles that they are, so that reading rounds nothing.
std::string exact(Color c) { return to_toml(Vec3d{c.r, c.g, c.b}); }

std::string light_key(size_t light, std::string_view key)
{
    return "light." + std::to_string(light) + "." + std::string(key);
}

// The key of a field of a type of light.
template <class Field>
std::string_view key_of(LightType type, Field LightDescription::*field)
{
    std::string_view key;
    for_each_parameter_of(type, [&](const auto& row) {
        if constexpr (std::is_same_v<decltype(row.field), Field LightDescription::*>)
            if (row.field == field) key = row.key;
    });
    return key;
}

// The key of a light's power.
std::string_view power_key(const LightDescription& l)
{
    if (!l.file.empty()) return "scale";  // of the picture
    return key_of(l.type, &LightDescription::power);
}

// A [[light]] of a scene file that says what the light is.
std::string table_of(const LightDescription& l)
{
    std::string text = "[[light]]\ntype = \"" + std::string(name_of(l.type)) + "\"\n";
    for_each_parameter_of(l.type, [&](const auto& row) {
        text += std::string(row.key) + " = ";
        using T = std::remove_cvref_t<decltype(l.*row.field)>;
        if constexpr (std::is_same_v<T, Color>)
            text += exact(l.*row.field) + "\n";
        else if constexpr (std::is_same_v<T, Vec3d>)
            text += to_toml(l.*row.field) + "\n";
        else
            text += shortest(l.*row.field) + "\n";
    });
    return text;
}

float least_of(ParameterRange range)
{
    return range == ParameterRange::finite     ? -std::numeric_limits<float>::infinity()
           : range == ParameterRange::positive ? 1e-6f
                                               : 0;
}
float most_of(ParameterRange range)
{
    return range == ParameterRange::unit ? 1 : std::numeric_limits<float>::infinity();
}

// f(row, field) for each parameter of the material that is a number or a colour.
template <class M, class F>
void for_each_number(M& material, const F& f)
{
    for_each_material_parameter([&](const auto& row) {
        auto& field = row.value_of(material);
        using T = std::remove_cvref_t<decltype(field)>;
        if constexpr (std::is_same_v<T, float> || std::is_same_v<T, Color>)
            if (has_parameter(material.type, row.key)) f(row, field);
    });
}

auto find_material(auto& materials, const std::string& name)
{
    return std::find_if(materials.begin(), materials.end(), [&](const auto& m) { return m.name == name; });
}

MaterialNumber in_range(MaterialNumber n)
{
    for (float& x : n.value) x = std::clamp(x, n.least, n.most);
    return n;
}

void apply(const MaterialNumber& number, MaterialDescription& material)
{
    for_each_number(material, [&](const auto& row, auto& field) {
        if (row.key != number.key) return;
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(field)>, Color>)
            field = {number.value[0], number.value[1], number.value[2]};
        else
            field = number.value[0];
    });
}

std::string text_of(const MaterialNumber& n)
{
    return n.count == 3 ? exact({n.value[0], n.value[1], n.value[2]}) : shortest(double{n.value[0]});
}

}  // namespace

EditedScene::EditedScene(SceneChoice choice, std::string added, SceneDescription scene, RenderSettings given,
                         RenderSettings opened)
    : choice_(std::move(choice)),
      added_(std::move(added)),
      given_(given),
      opened_(opened),
      scene_(std::make_shared<const SceneDescription>(std::move(scene))),
      as_opened_(scene_),
      lights_of_file_(scene_->lights.size())
{
}

SceneDescription& EditedScene::change()
{
    const auto changed = std::make_shared<SceneDescription>(*scene_);
    scene_ = changed;
    return *changed;
}

LightDescription& EditedScene::light(size_t index)
{
    LightDescription& l = change().lights[index];
    if (l.type == LightType::sphere || l.type == LightType::environment) ++rest_;
    return l;
}

void EditedScene::move_light(size_t i, Vec3d position)
{
    LightDescription& l = light(i);
    l.position = position;
    edits_[light_key(i, key_of(l.type, &LightDescription::position))] = to_toml(position);
}

void EditedScene::turn_light(size_t i, Vec3d direction)
{
    if (!(length(direction) > 0)) return;
    light(i).direction = direction;
    edits_[light_key(i, "direction")] = to_toml(direction);
}

void EditedScene::set_radius(size_t i, double radius)
{
    if (!(radius > 0)) return;
    light(i).radius = radius;
    edits_[light_key(i, "radius")] = shortest(radius);
}

void EditedScene::set_power(size_t i, Color power)
{
    LightDescription& l = light(i);
    l.power = power;
    edits_[light_key(i, power_key(l))] = exact(power);
}

void EditedScene::turn_sky(size_t i, Vec3d rotate_deg)
{
    light(i).rotate_deg = rotate_deg;
    edits_[light_key(i, "rotate")] = to_toml(rotate_deg);
}

size_t EditedScene::add_light(const LightDescription& light)
{
    ++rest_;
    change().lights.push_back(light);
    return scene_->lights.size() - 1;
}

bool EditedScene::can_move(size_t sphere) const
{
    const auto& s = scene_->spheres;
    return sphere < s.size() && s[sphere].part == SphereDescription::Part::whole &&
           std::all_of(s.begin(), s.begin() + static_cast<std::ptrdiff_t>(sphere),
                       [](const SphereDescription& other) { return other.part == SphereDescription::Part::whole; });
}

void EditedScene::move_sphere(size_t sphere, Vec3d center)
{
    ++rest_;
    change().spheres[sphere].center = center;
    edits_["sphere." + std::to_string(sphere) + ".center"] = to_toml(center);
}

std::optional<MaterialDescription> EditedScene::find(const std::string& material) const
{
    if (const auto found = find_material(scene_->materials, material); found != scene_->materials.end()) return *found;
    for (const MeshDescription& mesh : scene_->meshes) {
        if (!mesh.data || !mesh.material.empty()) continue;
        const auto found = find_material(mesh.data->materials, material);
        if (found == mesh.data->materials.end()) continue;
        const MaterialOverride* const over = find_override(*scene_, material);
        return over && over->change ? over->change(*found) : *found;
    }
    return {};
}

std::vector<MaterialNumber> EditedScene::numbers_of(const std::string& material) const
{
    std::vector<MaterialNumber> numbers;
    const auto found = find(material);
    if (!found) return numbers;
    for_each_number(*found, [&](const auto& row, const auto& field) {
        MaterialNumber n{std::string(row.key), {}, 1, least_of(row.range), most_of(row.range)};
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(field)>, Color>)
            n.value = {field.r, field.g, field.b}, n.count = 3;
        else
            n.value[0] = field;
        numbers.push_back(n);
    });
    return numbers;
}

void EditedScene::set_number(const std::string& material, const MaterialNumber& number)
{
    const MaterialNumber n = in_range(number);
    if (find_material(scene_->materials, material) == scene_->materials.end()) {
        if (find(material)) set_number_of_mesh(material, n);
        return;
    }
    ++rest_;
    apply(n, *find_material(change().materials, material));
    edits_["material.\"" + material + "\"." + n.key] = text_of(n);
}

// As an override before all others, which changes what the one of the scene file makes of it, if there is one.
void EditedScene::set_number_of_mesh(const std::string& material, const MaterialNumber& number)
{
    std::vector<MaterialNumber>& numbers = mesh_edits_[material];
    std::erase_if(numbers, [&](const MaterialNumber& n) { return n.key == number.key; });
    numbers.push_back(number);
    MaterialOverride mine;
    mine.match = pattern_of(material);
    const MaterialOverride* const first = find_override(*as_opened_, material);
    mine.change = [of_file = first ? first->change : nullptr, numbers](const MaterialDescription& before) {
        MaterialDescription m = of_file ? of_file(before) : before;
        for (const MaterialNumber& n : numbers) apply(n, m);
        return m;
    };
    ++rest_;
    auto& overrides = change().overrides;
    const size_t made = overrides.size() - as_opened_->overrides.size();
    const auto end = overrides.begin() + static_cast<std::ptrdiff_t>(made);
    const auto old = std::find_if(overrides.begin(), end, [&](const auto& o) { return o.match == mine.match; });
    if (old != end)
        *old = std::move(mine);
    else
        overrides.insert(overrides.begin(), std::move(mine));
}

std::string EditedScene::text(const CameraDescription& camera, const RenderSettings& settings,
                              const OutputDescription& output) const
{
    SceneEdits edits;
    const auto is_of_added = [&](const std::string& key) {
        for (size_t i = lights_of_file_; i < scene_->lights.size(); ++i)
            if (key.starts_with(light_key(i, ""))) return true;
        return false;
    };
    for (const auto& [key, value] : edits_)
        if (!is_of_added(key)) edits.definitions.push_back(key + "=" + value);
    for (const auto& [material, numbers] : mesh_edits_) {
        MaterialEdit& edit = edits.materials.emplace_back(MaterialEdit{.material = material, .values = {}});
        for (const MaterialNumber& n : numbers) edit.values.emplace_back(n.key, text_of(n));
    }
    std::string added = added_;
    for (size_t i = lights_of_file_; i < scene_->lights.size(); ++i) added += "\n" + table_of(scene_->lights[i]);
    if (camera.type == CameraType::thin_lens) {
        edits.definitions.emplace_back("camera.type=thin_lens");
        edits.definitions.push_back("camera.aperture=" + shortest(camera.aperture));
        if (camera.focus) edits.definitions.push_back("camera.focus=" + shortest(*camera.focus));
    }
    RenderSettings given = given_;
    RenderSettings changed = settings;
    changed.given = 0;
    for (const RenderOption& option : render_options())
        if (value_text(settings, option) != value_text(opened_, option)) mark_given(changed, option);
    override_with(given, changed);
    // Another integrator has another depth of its own.
    if (settings.integrator != opened_.integrator) given.give(&RenderSettings::max_depth, settings.max_depth);
    return completed_scene_text(choice_, added, camera, given, output, edits);
}

}  // namespace lancer
