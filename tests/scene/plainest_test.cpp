// A principled material that says no more than a plainer type is of that type.
#include <gtest/gtest.h>

#include "scene/description/as_principled.h"
#include "scene/description/material.h"
#include "support/render.h"
#include "support/scenes/scenes.h"
#include "support/shoot.h"
#include "support/stage.h"

namespace lancer {
namespace {

MaterialDescription principled(const std::function<void(MaterialDescription&)>& change)
{
    MaterialDescription m = default_description(MaterialType::principled);
    m.name = "m";
    m.base_color = {0.25f, 0.5f, 0.75f};
    m.roughness = 0.5f;
    change(m);
    return m;
}
MaterialDescription plain(MaterialType type, const std::function<void(MaterialDescription&)>& change)
{
    MaterialDescription m = default_description(type);
    m.name = "m";
    m.base_color = {0.25f, 0.5f, 0.75f};
    change(m);
    return m;
}

struct Pair {
    MaterialDescription principled, plain;
};
std::vector<Pair> pairs()
{
    using D = MaterialDescription;
    return {
        {principled([](D& m) { m.specular_weight = 0; }), plain(MaterialType::lambert, [](D&) {})},
        {principled([](D& m) {
             m.ior = 1.7f, m.specular = {0.5f, 1, 0.5f};
         }),
         plain(MaterialType::plastic,
               [](D& m) {
                   m.roughness = 0.5f, m.ior = 1.7f, m.specular = {0.5f, 1, 0.5f};
               })},
        {principled([](D& m) { m.metallic = 0.25f; }),
         plain(MaterialType::plastic, [](D& m) { m.roughness = 0.5f, m.metallic = 0.25f; })},
        {principled([](D& m) { m.metallic = 1.0f; }),
         plain(MaterialType::metal, [](D& m) { m.roughness = 0.5f, m.metallic = 1.0f; })},
        {principled([](D& m) {
             m.metallic = 1.0f, m.base_color = {1, 1, 1}, m.roughness = 0;
         }),
         plain(MaterialType::mirror,
               [](D& m) {
                   m.base_color = {1, 1, 1};
               })},
        {principled([](D& m) { m.transmission = 1, m.ior = 1.3f; }), plain(MaterialType::glass,
                                                                           [](D& m) {
                                                                               m.base_color = {1, 1, 1};
                                                                               m.roughness = 0.5f, m.ior = 1.3f;
                                                                           })},
        {principled([](D& m) { m.transmission = 1, m.thin = true, m.roughness = 0; }),
         plain(MaterialType::glass,
               [](D& m) {
                   m.base_color = {1, 1, 1}, m.thin = true;
               })},
        {principled([](D& m) {
             m.transmission = 1, m.transmission_depth = 2, m.transmittance = {std::exp(-1.0f), 1, 1}, m.roughness = 0;
         }),
         plain(MaterialType::glass, [](D& m) {
             m.base_color = {1, 1, 1}, m.absorption = {0.5f, 0, 0};
         })}};
}

TEST(Plainest, IsThePlainMaterial)
{
    for (const Pair& p : pairs()) {
        MaterialDescription found = plainest(p.principled);
        if (found.type == MaterialType::mirror) found.roughness = p.plain.roughness;
        EXPECT_EQ(found.metallic.value_or(2), found.type == MaterialType::metal || found.metallic
                                                  ? p.plain.metallic.value_or(found.metallic.value_or(2))
                                                  : 2);
        EXPECT_EQ(name_of(found.type), name_of(p.plain.type));
        EXPECT_EQ(found.base_color, p.plain.base_color) << name_of(found.type);
        EXPECT_EQ(found.roughness, p.plain.roughness) << name_of(found.type);
        EXPECT_EQ(found.thin, p.plain.thin);
        if (has_parameter(found.type, "ior")) {
            EXPECT_EQ(found.ior, p.plain.ior);
        }
        EXPECT_NEAR(found.absorption.r, p.plain.absorption.r, 1e-6f);
        EXPECT_EQ(found.coat, 0);
    }
}

// On a ball under a lamp and a sky.
SceneDescription scene_of(const MaterialDescription& m)
{
    SceneDescription d = lights_scene();
    d.materials.push_back(m);
    d.spheres.push_back(sphere_of({0, 0.1, 0.6}, 0.3, "m"));
    return d;
}

TEST(Plainest, HasTheSameBits)
{
    for (const Pair& p : pairs()) {
        if (p.plain.absorption.r > 0) continue;  // whose logarithm is not that of the description
        RenderRequest request;
        request.spp = {4};
        const auto a = render(scene_of(p.principled), request), b = render(scene_of(p.plain), request);
        EXPECT_TRUE(same_bits(a.film, b.film)) << name_of(p.plain.type);
    }
}

TEST(Plainest, KeepsWhatSaysMore)
{
    using D = MaterialDescription;
    const std::vector<std::function<void(D&)>> more{[](D& m) { m.coat = 0.1f; },
                                                    [](D& m) { m.fuzz = 0.1f; },
                                                    [](D& m) { m.film = 0.1f; },
                                                    [](D& m) { m.anisotropy = 0.5f; },
                                                    [](D& m) { m.diffuse_roughness = 0.5f; },
                                                    [](D& m) { m.transmission = 0.5f; },
                                                    [](D& m) {
                                                        m.transmission = 1, m.transmittance = {0.5f, 1, 1};
                                                    },
                                                    [](D& m) {
                                                        m.metallic = 1.0f, m.specular = {1, 0.5f, 1};
                                                    }};
    for (const auto& change : more) EXPECT_EQ(plainest(principled(change)).type, MaterialType::principled);
}

// There and back.
TEST(Plainest, UndoesAsPrincipled)
{
    for (const MaterialType type : {MaterialType::lambert, MaterialType::plastic, MaterialType::metal}) {
        MaterialDescription m = plain(type, [](MaterialDescription& d) { d.roughness = 0.5f; });
        ASSERT_TRUE(as_principled(m));
        EXPECT_EQ(m.type, MaterialType::principled);
        EXPECT_EQ(name_of(plainest(m).type), name_of(type));
    }
    MaterialDescription mix = default_description(MaterialType::mix);
    EXPECT_FALSE(as_principled(mix));
}

}  // namespace
}  // namespace lancer
