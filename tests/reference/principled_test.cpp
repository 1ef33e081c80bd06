// The principled material against the reference's, direction by direction.
#include "reference/principled.h"

#include <gtest/gtest.h>

#include "materials/principled.h"
#include "scene/build/material_builder.h"
#include "support/random.h"

namespace reference {
namespace {

using lancer::MaterialDescription;

MaterialDescription described(const std::function<void(MaterialDescription&)>& change)
{
    MaterialDescription m = lancer::default_description(lancer::MaterialType::principled);
    m.base_color = {0.8f, 0.5f, 0.2f};
    change(m);
    return m;
}

// tolerance: of the tables of both.
void expect_same(const std::string& name, const MaterialDescription& m, double tolerance)
{
    const lancer::Material any =
        lancer::MaterialBuilder({}).make(m, [](const lancer::TextureUse&) { return lancer::no_texture; });
    const auto bsdf = std::get<lancer::Principled>(any).at({});
    const PrincipledModel model(m);
    const Rgb base{double{m.base_color.r}, double{m.base_color.g}, double{m.base_color.b}};
    lancer::Random random(1);
    const auto direction = [&] {
        lancer::Vec3 w = random.unit_vector();
        w.z = std::max(0.05f, std::abs(w.z));
        return lancer::normalize(w);
    };
    const auto wide = [](lancer::Vec3 w) { return Vec{double{w.x}, double{w.y}, double{w.z}}; };
    const auto expect_near = [&](lancer::Color ours, Rgb theirs, const char* what) {
        const double bound = tolerance * largest(theirs) + 1e-4;
        EXPECT_NEAR(ours.r, theirs.r, bound) << name << what;
        EXPECT_NEAR(ours.g, theirs.g, bound) << name << what;
        EXPECT_NEAR(ours.b, theirs.b, bound) << name << what;
    };
    for (int i = 0; i < 200; ++i) {
        const lancer::Vec3 wo = direction(), wi = direction();
        expect_near(bsdf.eval(wo, wi).f_cos, model.eval(wide(wo), wide(wi), base), ", value");
        const auto first = bsdf.sample(wo, 0, {});
        const Rgb sharp = model.mirror(wide(wo), base);
        ASSERT_EQ(first && first->delta, !black(sharp)) << name;
        if (first && first->delta) expect_near(first->weight * first->pdf, sharp, ", mirror");
    }
}

TEST(PrincipledReference, HasTheSameValues)
{
    expect_same("plain", described([](auto& m) { m.roughness = 0.6f, m.specular_weight = 0.5f; }), 0.01);
    expect_same("smooth", described([](auto& m) { m.roughness = 0, m.ior = 1.8f; }), 0.01);
    expect_same("metal", described([](auto& m) {
                    m.metallic = 1.0f, m.roughness = 0.7f, m.specular = {0.2f, 0.8f, 1}, m.specular_weight = 0.8f;
                }),
                0.02);
    expect_same("half metal", described([](auto& m) { m.metallic = 0.4f, m.roughness = 0.5f; }), 0.02);
    expect_same("coated", described([](auto& m) { m.coat = 0.8f, m.coat_color = {0.9f, 0.6f, 0.3f}; }), 0.02);
    expect_same("roughly coated",
                described([](auto& m) { m.coat = 1, m.coat_roughness = 0.5f, m.roughness = 0.4f, m.metallic = 0.3f; }),
                0.02);
    expect_same("fuzzy", described([](auto& m) { m.fuzz = 0.7f, m.fuzz_color = {0.3f, 0.9f, 0.5f}; }), 0.02);
    expect_same("finely fuzzy", described([](auto& m) { m.fuzz = 1, m.fuzz_roughness = 0.1f; }), 0.03);
    expect_same("rough body", described([](auto& m) { m.diffuse_roughness = 0.8f, m.specular_weight = 0; }), 0.01);
    expect_same("film", described([](auto& m) { m.film = 0.8f, m.film_ior = 1.9f, m.roughness = 0.6f; }), 0.03);
    expect_same("smooth film",
                described([](auto& m) { m.film = 1, m.film_thickness = 250, m.roughness = 0, m.metallic = 0.5f; }),
                0.03);
}

}  // namespace
}  // namespace reference
