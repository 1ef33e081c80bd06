// Cameras and lights. glTF's look along -z of their nodes, with y up.
#include <cmath>
#include <set>

#include "core/bounds.h"
#include "core/names.h"
#include "io/gltf/gltf.h"
#include "io/gltf/nodes.h"

namespace lancer {
namespace {

TomlValue to_toml_value(Vec3d v) { return {.data = TomlValue::Array{{.data = v.x}, {.data = v.y}, {.data = v.z}}}; }
TomlEntry toml_entry(std::string key, TomlValue value) { return {.key = std::move(key), .value = std::move(value)}; }

class TableMaker {
public:
    explicit TableMaker(const std::string& path) : doc_(path, GltfDocument::Extent::json), scene_(read_gltf_nodes(doc_))
    {
    }

    TomlValue::Table make()
    {
        TomlValue::Table root;
        for (const GltfPlaced& p : scene_.cameras) add_camera(p);
        if (!cameras_.empty()) {
            if (aspect_ > 0) root.push_back(toml_entry("render", {.data = TomlValue::Table{size_entry()}}));
            root.push_back(toml_entry("camera", {.data = std::move(cameras_)}));
        }
        for (const GltfPlaced& p : scene_.lights) add_light(p);
        if (!lights_.empty()) root.push_back(toml_entry("light", {.data = std::move(lights_)}));
        return root;
    }
    void tell(Diagnostics& diagnostics) const { doc_.warnings().tell(doc_.path(), diagnostics); }

private:
    // Of the first camera, as high as the usual picture.
    TomlEntry size_entry() const
    {
        constexpr double height = 720, widest = 65536;
        const double width = std::clamp(std::round(height * aspect_), 1.0, widest);
        return toml_entry("size", {.data = TomlValue::Array{{.data = static_cast<int64_t>(width)},
                                                            {.data = static_cast<int64_t>(height)}}});
    }

    // What accessors say of the bounds of all meshes.
    Bounds bounds() const
    {
        Bounds all;
        for (const GltfPlaced& p : scene_.meshes) {
            const JsonValue::Array* const primitives = doc_.array(*p.what, "primitives");
            for (size_t i = 0; primitives && i < primitives->size(); ++i) {
                const JsonValue* const attributes = doc_.object((*primitives)[i], "attributes");
                const JsonValue* const a = attributes ? doc_.refer(*attributes, "POSITION", "accessors") : nullptr;
                if (!a || !a->member("min") || !a->member("max")) continue;
                const auto least = doc_.numbers<3>(*a, "min"), most = doc_.numbers<3>(*a, "max");
                Bounds own;
                own.grow(Vec3d{(*least)[0], (*least)[1], (*least)[2]});
                own.grow(Vec3d{(*most)[0], (*most)[1], (*most)[2]});
                for (int corner = 0; corner < 8; ++corner)
                    all.grow(p.to_world.point({corner & 1 ? own.upper.x : own.lower.x,
                                               corner & 2 ? own.upper.y : own.lower.y,
                                               corner & 4 ? own.upper.z : own.lower.z}));
            }
        }
        return all;
    }

    // To what a camera looks at: as far as the middle of the scene, if that lies before it.
    double distance(Vec3d from, Vec3d way)
    {
        if (!bounds_) bounds_ = bounds();
        const double along = bounds_->empty() ? 0 : dot(bounds_->center() - from, way);
        return along > 0 && std::isfinite(along) ? along : 1;
    }

    std::string name_of(const GltfPlaced& p, const char* usual)
    {
        const std::string* name = p.node ? doc_.text(*p.node, "name") : nullptr;
        if (!name || name->empty()) name = doc_.text(*p.what, "name");
        const bool is_key = name && (*name == "type" || *name == "position" || *name == "target" || *name == "up" ||
                                     *name == "fov" || *name == "aperture" || *name == "focus" || *name == "inside");
        const std::string wanted = !name || name->empty() || is_key ? usual : *name;
        std::string own = wanted;
        for (size_t n = 2; !names_.insert(own).second; ++n) own = wanted + " " + std::to_string(n);
        return own;
    }

    void add_camera(const GltfPlaced& p)
    {
        const std::string* const type = doc_.text(*p.what, "type");
        const JsonValue* const perspective = doc_.object(*p.what, "perspective");
        if (!type || *type != "perspective" || !perspective)
            return doc_.warn(*p.what, "a camera that is not a perspective one is not used");
        const double yfov = doc_.number(*perspective, "yfov").value_or(0);
        if (!(yfov > 0 && yfov < pi_d)) doc_.fail(*perspective, "'yfov' is not between 0 and pi");
        const Vec3d way = p.to_world.vector({0, 0, -1}), up = p.to_world.vector({0, 1, 0});
        const Vec3d position = p.to_world.translation;
        if (!(length(way) > 0) || !(length(cross(way, up)) > 0))
            return doc_.warn(*p.node, "a camera whose node has no size is not used");
        const Vec3d unit = normalize(way / max_component(abs(way)));
        const TomlValue::Table keys{toml_entry("position", to_toml_value(position)),
                                    toml_entry("target", to_toml_value(position + unit * distance(position, unit))),
                                    toml_entry("up", to_toml_value(normalize(up / max_component(abs(up))))),
                                    toml_entry("fov", {.data = yfov * 180 / pi_d})};
        if (cameras_.empty()) {
            cameras_ = keys;
            if (const auto aspect = doc_.number(*perspective, "aspectRatio")) aspect_ = *aspect;
        }
        cameras_.push_back(toml_entry(name_of(p, "camera"), {.data = keys}));
    }

    // A file has one unit for lights and emission. The specification's are photometric throughout: candela, lux and
    // nits; as these they are taken, so that a picture holds nits. Blender writes the emission of materials in
    // W/(m^2 sr), and of lamps so many lumens for each watt.
    double unit() const
    {
        constexpr double lumens_of_blender = 683;
        const JsonValue* const asset = doc_.object(doc_.root(), "asset");
        const std::string* const generator = asset ? doc_.text(*asset, "generator") : nullptr;
        return generator && generator->find("Blender I/O") != std::string::npos ? 1 / lumens_of_blender : 1;
    }

    void add_cone(const JsonValue& light, Vec3d way, TomlValue::Table& keys)
    {
        constexpr double usual_outer = pi_d / 4;
        const JsonValue* const spot = doc_.object(light, "spot");
        const auto angle = [&](std::string_view key, double usual) {
            return spot ? doc_.number(*spot, key).value_or(usual) : usual;
        };
        const double inner = angle("innerConeAngle", 0), outer = angle("outerConeAngle", usual_outer);
        if (!(inner >= 0 && inner < outer && outer <= pi_d / 2 + 1e-6))
            doc_.fail(light, "the angles of the cone are not from 0 to pi / 2, the inner one less than the outer one");
        keys.push_back(toml_entry("direction", to_toml_value(way)));
        keys.push_back(toml_entry("inner_angle", {.data = inner * 180 / pi_d}));
        keys.push_back(toml_entry("outer_angle", {.data = std::min(outer * 180 / pi_d, 90.0)}));
    }

    void add_light(const GltfPlaced& p)
    {
        const std::string* const type = doc_.text(*p.what, "type");
        const auto color = doc_.numbers<3>(*p.what, "color").value_or(std::array{1.0, 1.0, 1.0});
        const double power = doc_.number(*p.what, "intensity").value_or(1) * unit();
        const Vec3d shown{color[0] * power, color[1] * power, color[2] * power};
        if (!(std::min({shown.x, shown.y, shown.z}) >= 0)) doc_.fail(*p.what, "the light is negative");
        if (shown == Vec3d{}) return;
        if (p.what->member("range")) doc_.warn(*p.what, "the range of a light is not used: light has none");
        TomlValue::Table keys;
        const Vec3d way = p.to_world.vector({0, 0, -1});
        if (type && *type != "point" && way == Vec3d{})
            return doc_.warn(*p.node, "a light whose node has no size is not used");
        if (type && *type == "directional") {
            keys = {toml_entry("type", {.data = std::string("directional")}),
                    toml_entry("direction", to_toml_value(way)), toml_entry("irradiance", to_toml_value(shown))};
        } else if (type && (*type == "point" || *type == "spot")) {
            keys = {toml_entry("type", {.data = *type}), toml_entry("position", to_toml_value(p.to_world.translation)),
                    toml_entry("intensity", to_toml_value(shown))};
            if (*type == "spot") add_cone(*p.what, way, keys);
        } else {
            return doc_.warn(*p.what, "a light that is neither directional, point nor spot is not used");
        }
        lights_.push_back({.data = std::move(keys)});
    }

    GltfDocument doc_;
    GltfScene scene_;
    TomlValue::Table cameras_;
    TomlValue::Array lights_;
    std::set<std::string> names_;
    std::optional<Bounds> bounds_;
    double aspect_ = 0;
};

}  // namespace

TomlValue::Table gltf_tables(const std::string& path, Diagnostics& diagnostics)
{
    TableMaker maker(path);
    TomlValue::Table tables = maker.make();
    maker.tell(diagnostics);
    return tables;
}

}  // namespace lancer
