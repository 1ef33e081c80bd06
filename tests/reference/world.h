// The scene as the reference integrator has it: everything in the file's units and in double, instances written out as
// triangles of their own, names resolved.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reference/placing.h"
#include "reference/scattering.h"
#include "reference/texture.h"

namespace reference {

// Parameters beside their textures; a mix has its two parts by number.
struct Material {
    lancer::MaterialDescription what;
    const Texture *base = nullptr, *transmittance = nullptr, *roughness = nullptr, *opacity = nullptr, *bump = nullptr,
                  *normals = nullptr, *emission = nullptr, *weight = nullptr;
    size_t first = 0, second = 0;              // mix
    bool mirrors = false;                      // it, or a part of it, has a lobe about the mirror direction
    std::shared_ptr<const CoatAlbedo> coat{};  // plastic
    std::shared_ptr<const PrincipledModel> principled{};
    Rgb mean_of_conductor{};  // metal by its indices: its mean reflectance
    bool has_holes() const { return opacity || what.opacity < 1; }
    bool is_mix() const { return what.type == lancer::MaterialType::mix; }
    // What a body of it is filled with.
    bool bounds_medium() const;
    double medium_index() const;  // with a priority: its own; else over that of what is around
    // Whether its surface is nothing where the indices of both sides are the same: clear, of index 1, around a medium.
    bool is_bare() const;
};

struct Triangle {
    Vec a, b, c;  // as the file has them in order
    Vec n;        // of the front, unit
    std::optional<std::array<Vec, 3>> normals{};
    std::optional<std::array<Uv, 3>> uvs{};
    std::optional<std::array<Rgb, 3>> colors{};
    // For a map of normals: along +u, and the bitangent over cross(normal, along).
    std::optional<std::array<Vec, 3>> tangents{};
    double bitangent_sign = 1;
    size_t material = 0;
    uint32_t mesh = 0, instance = UINT32_MAX, primitive = 0;  // its place in the description
};
struct Sphere {
    Vec center;
    double radius;
    size_t material;
};
struct Plane {
    Vec point, n;
    size_t material;
    Vec uv_origin, u, v;  // texture coordinates are the products of these with what leads there from uv_origin
    Vec step_u, step_v;   // along which u, v grow by 1
};

struct World {
    std::vector<std::unique_ptr<Texture>> textures;
    std::vector<Material> materials;
    std::vector<Triangle> triangles;
    std::vector<Sphere> spheres;
    std::vector<Plane> planes;
    struct Point {
        Vec at;
        Rgb intensity;
        // Of a spot: its middle, unit, and the cosines at which it begins to fade and is dark.
        Vec middle{};
        double inner = -2, outer = -3;
        Rgb intensity_towards(Vec unit_way) const
        {
            const double part = std::clamp((dot(unit_way, middle) - outer) / (inner - outer), 0.0, 1.0);
            return intensity * (part * part);
        }
    };
    struct Directional {
        Vec towards;
        Rgb irradiance;
    };
    std::vector<Point> points;
    std::vector<Directional> directionals;
    Rgb constant_sky;
    std::optional<Texels> sky_picture;
    Rgb sky_factor;
    Linear sky_rotation;
    std::optional<lancer::BackgroundDescription> background;
    bool glow = false;
    bool multiscatter = true;
    std::optional<size_t> camera_medium;  // a material
    std::optional<lancer::FogDescription> fog;

    // Throws std::invalid_argument for what the reference does not know: switches of [render] that change the picture,
    // textured roughness of plastic and of what has multiple scattering, pictures as background.
    World(const lancer::SceneDescription& description, const lancer::RasterSource& images);

    Rgb sky(Vec direction, bool is_seen, Vec from) const;
    // Whether light goes straight on through surfaces that are not there: if some body has one that is nothing.
    bool has_bare() const;
};

}  // namespace reference
