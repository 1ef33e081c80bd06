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

Principled make_principled(const std::function<void(MaterialDescription&)>& change)
{
    MaterialDescription m = default_description(MaterialType::principled);
    m.base_color = {1, 1, 1};
    change(m);
    return std::get<Principled>(MaterialBuilder({}).make(m, [](const TextureUse&) { return no_texture; }));
}

template <>
std::vector<Sample<Principled>> samples<Principled>()
{
    using D = MaterialDescription;
    // White ones lose nothing, up to what tables and the stated approximations promise.
    const auto white = [](const std::string& name, double tolerance, const std::function<void(D&)>& change) {
        const Principled p = make_principled(change);
        const bool films_body = p.film.value > 0 && p.transmission.value < 1 && p.metallic.value < 1;
        const bool one_way = p.coat.value > 0 || p.fuzz.value > 0 || films_body || p.diffuse_roughness > 0;
        return Sample<Principled>{name,
                                  p,
                                  true,
                                  p.transmission.value > 0,
                                  tolerance,
                                  false,
                                  false,
                                  one_way,
                                  p.diffuse_roughness > 0 || p.anisotropy.value > 0};
    };
    const auto dyed = [&](const std::string& name, const std::function<void(D&)>& change) {
        Sample<Principled> s = white(name, 0.01, [&](D& m) {
            m.base_color = {0.8f, 0.3f, 0.05f};
            change(m);
        });
        s.lossless = false;
        return s;
    };
    static const std::vector<Sample<Principled>> all{
        white("white", table_error, [](D& m) { m.roughness = 0.6f; }),
        white("white smooth", 1e-3, [](D& m) { m.roughness = 0; }),
        white("white metal", table_error, [](D& m) { m.metallic = 1.0f, m.roughness = 0.7f; }),
        white("white glass", table_error, [](D& m) { m.transmission = 1, m.roughness = 0.7f; }),
        white("white smooth glass", 1e-4, [](D& m) { m.transmission = 1, m.roughness = 0; }),
        white("white pane", 1e-4, [](D& m) { m.transmission = 1, m.roughness = 0, m.thin = true; }),
        white("white of all bases", 0.01, [](D& m) { m.transmission = 0.5f, m.metallic = 0.4f, m.roughness = 0.6f; }),
        white("white of all smooth bases", 1e-3,
              [](D& m) { m.transmission = 0.5f, m.metallic = 0.4f, m.roughness = 0; }),
        white("white brushed metal", 0.01,
              [](D& m) { m.metallic = 1.0f, m.roughness = 0.6f, m.anisotropy = 0.8f, m.anisotropy_rotation = 0.15f; }),
        white("white roughest brushed metal", 0.01,
              [](D& m) { m.metallic = 1.0f, m.roughness = 1, m.anisotropy = 0.9f; }),
        white("white brushed", 0.01, [](D& m) { m.roughness = 0.8f, m.anisotropy = 0.7f; }),
        white("white thinner than what is outside", table_error, [](D& m) { m.ior = 0.6f, m.roughness = 0.6f; }),
        white("white brushed and thinner than what is outside", 0.02,
              [](D& m) { m.ior = 0.6f, m.roughness = 0.7f, m.anisotropy = 0.8f; }),
        white("white under a coat that is thinner than what is outside", 0.01,
              [](D& m) { m.coat = 1, m.coat_ior = 0.6f, m.coat_roughness = 0.6f, m.roughness = 0.7f; }),
        white("white coated", 0.01, [](D& m) { m.coat = 1, m.roughness = 0.7f; }),
        white("white roughly coated", 0.01, [](D& m) { m.coat = 0.8f, m.coat_roughness = 0.5f, m.roughness = 0.5f; }),
        white("white coated metal", 0.01, [](D& m) { m.coat = 1, m.metallic = 1.0f, m.roughness = 0.5f; }),
        white("white coated glass", 0.01, [](D& m) { m.coat = 1, m.transmission = 1, m.roughness = 0; }),
        // A rough coat alone makes the base rough, of which both sides of a body and both directions of a metal know.
        white("white glass under a rough coat", 0.01,
              [](D& m) { m.coat = 1, m.coat_roughness = 0.6f, m.transmission = 1, m.roughness = 0; }),
        white(
            "white brushed under a rough coat", 0.01,
            [](D& m) { m.coat = 1, m.coat_roughness = 0.6f, m.metallic = 0.5f, m.roughness = 0, m.anisotropy = 0.5f; }),
        white("white fuzzy", 0.01, [](D& m) { m.fuzz = 1, m.roughness = 0.7f; }),
        white("white finely fuzzy metal", 0.02,
              [](D& m) { m.fuzz = 1, m.fuzz_roughness = 0, m.metallic = 1.0f, m.roughness = 0.5f; }),
        white("white iridescent", 0.01, [](D& m) { m.film = 1, m.film_thickness = 300, m.roughness = 0.7f; }),
        white("white iridescent smooth", 0.01, [](D& m) { m.film = 0.5f, m.film_ior = 1.9f, m.roughness = 0; }),
        white("white iridescent metal", 0.01, [](D& m) { m.film = 1, m.metallic = 1.0f, m.roughness = 0.5f; }),
        white("bubble", 0.01,
              [](D& m) { m.film = 1, m.film_thickness = 300, m.transmission = 1, m.thin = true, m.roughness = 0; }),
        white("iridescent glass", 0.01, [](D& m) { m.film = 1, m.transmission = 1, m.roughness = 0.5f; }),
        white("iridescent ground glass", 0.01,
              [](D& m) { m.film = 0.7f, m.film_ior = 2, m.transmission = 1, m.roughness = 1; }),
        white("iridescent frosted bubble", 0.01,
              [](D& m) { m.film = 1, m.film_ior = 2, m.ior = 0.7f, m.transmission = 1, m.roughness = 0.7f; }),
        white("iridescent ground pane", 0.01,
              [](D& m) { m.film = 1, m.film_ior = 2, m.transmission = 1, m.thin = true, m.roughness = 1; }),
        white("white rough body", 0.01, [](D& m) { m.diffuse_roughness = 1, m.roughness = 0.7f; }),
        white("white half rough body", 0.01, [](D& m) { m.diffuse_roughness = 0.5f, m.roughness = 0.7f; }),
        white("white of all layers", 0.02,
              [](D& m) {
                  m.coat = 0.5f, m.fuzz = 0.5f, m.film = 0.5f, m.diffuse_roughness = 0.5f;
                  m.metallic = 0.3f, m.transmission = 0.3f, m.roughness = 0.6f, m.anisotropy = 0.5f;
              }),
        dyed("dyed",
             [](D& m) {
                 m.roughness = 0.6f, m.specular = {0.5f, 1, 0.2f}, m.specular_weight = 0.7f;
             }),
        dyed("metal with a tinted edge",
             [](D& m) {
                 m.metallic = 1.0f, m.roughness = 0.6f, m.specular = {0.1f, 0.5f, 1};
             }),
        dyed("tinted glass",
             [](D& m) {
                 m.transmission = 1, m.roughness = 0.6f, m.transmittance = {0.2f, 0.9f, 0.5f};
             }),
        dyed("of a dyed coat",
             [](D& m) {
                 m.coat = 1, m.coat_color = {0.9f, 0.5f, 0.1f}, m.roughness = 0.6f;
             }),
        dyed("velvet",
             [](D& m) {
                 m.fuzz = 1, m.fuzz_color = {0.2f, 0.4f, 1}, m.specular_weight = 0;
             }),
        dyed("black", [](D& m) { m.base_color = {}, m.specular = {}, m.roughness = 0.6f; }),
        dyed("of a rough diffuse body", [](D& m) { m.diffuse_roughness = 1, m.specular_weight = 0; })};
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
