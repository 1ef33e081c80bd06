#include "materials/samples.h"

namespace lancer {

Plastic make_plastic(Color base, float roughness, float ior, Color specular)
{
    std::shared_ptr<AlbedoTable> coat;
    if (roughness > 0) {
        coat = std::make_shared<AlbedoTable>(FacetKind::coat, static_cast<double>(ior));
        coat->need_all();
    }
    return {base, roughness, ior, specular, static_cast<float>(mean_transmittance(double{ior})), coat};
}

Glass make_glass(Color tint, float ior, float roughness, bool thin)
{
    MaterialDescription m = default_description(MaterialType::glass);
    m.base_color = tint, m.ior = ior, m.roughness = roughness, m.thin = thin;
    return std::get<Glass>(MaterialBuilder({}).make(m, [](const TextureUse&) { return no_texture; }));
}

std::shared_ptr<const AlbedoTable> table_of_reflectors()
{
    static const std::shared_ptr<const AlbedoTable> all = [] {
        auto t = std::make_shared<AlbedoTable>(FacetKind::reflector);
        t->need_all();
        return t;
    }();
    return all;
}

std::vector<Place> places()
{
    std::vector<Place> all;
    double phi = 0.3;
    for (const bool front : {true, false})
        for (const double z : {1.0, 0.8, 0.5, 0.2, 0.02}) {
            const double r = std::sqrt(1 - z * z);
            phi += 2.1;
            all.push_back({std::string(front ? "front" : "back") + " cos " + std::to_string(z),
                           {.front = front},
                           to_float(Vec3d{r * std::cos(phi), r * std::sin(phi), z})});
        }
    return all;
}

}  // namespace lancer
