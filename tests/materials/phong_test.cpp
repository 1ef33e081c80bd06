// What the classic integrators are told of each material: no more light than there is, and the material's own colour.
#include "materials/phong.h"

#include <gtest/gtest.h>

#include "core/ray.h"
#include "materials/alternatives.h"
#include "materials/samples.h"
#include "support/statistics/significance.h"

namespace lancer {
namespace {

template <class M>
class PhongOfMaterials : public testing::Test {
};
TYPED_TEST_SUITE(PhongOfMaterials, Alternatives<Material>::Types);

std::array<float, 3> channels(Color c) { return {c.r, c.g, c.b}; }

// How far the classic view of a material may be from its own albedo: a coat of plastic reflects by the Fresnel
// equations there, most where it reflects totally, and here the same from everywhere. Layers of a principled material
// are left out.
template <class M>
float far_from_own_albedo()
{
    if (std::is_same_v<M, Principled>) return 0.3f;
    return std::is_same_v<M, Plastic> ? 0.15f : gamma(8);
}

// What a material sends back to the side of the light and by mirrors and boundaries: the classic model has no diffuse
// transmission.
template <class B>
Color albedo_without_diffuse_transmission(const B& bsdf)
{
    if constexpr (requires { bsdf.reflected(); })
        return bsdf.reflected();
    else
        return bsdf.reflectance();
}

TYPED_TEST(PhongOfMaterials, HasTheColourOfTheMaterial)
{
    for (const auto& s : samples<TypeParam>())
        for (const bool front : {true, false}) {
            const ShadingPoint point{.front = front};
            const auto seen = channels(InterfaceBsdf(s.material.phong(point), front).reflectance());
            const auto own = channels(albedo_without_diffuse_transmission(s.material.at(point)));
            for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(seen[i], own[i], far_from_own_albedo<TypeParam>()) << s.name;
        }
}

TYPED_TEST(PhongOfMaterials, SendsBackNoMoreThanItGets)
{
    Random random(9);
    for (const auto& s : samples<TypeParam>())
        for (const Place& p : places()) {
            const InterfaceBsdf bsdf(s.material.phong(p.point), p.point.front);
            stats::Tally energy;
            for (int i = 0; i < 500; ++i) {
                const float u = random.unit();
                const auto w = bsdf.sample(p.wo, u, random.unit2());
                energy.add(w ? static_cast<double>(max_component(w->weight) * (w->eta * w->eta)) : 0);
            }
            EXPECT_LE(energy.mean - 5 * energy.error(), 1 + 1e-5) << s.name << " " << p.name;
        }
}

// Its numbers are what the model asks for, and but for those that a user wrote into an interface they add up to no more
// than all light.
TYPED_TEST(PhongOfMaterials, StaysInItsRanges)
{
    for (const auto& s : samples<TypeParam>()) {
        const Phong p = s.material.phong({});
        for (const float part : {p.diffusion, p.reflexion, p.refraction}) EXPECT_TRUE(part >= 0 && part <= 1) << s.name;
        EXPECT_GE(p.shininess, 0) << s.name;
        EXPECT_TRUE(p.inside_ior > 0 && p.outside_ior > 0) << s.name;
        const auto diffuse = channels(p.diffuse), specular = channels(p.specular);
        for (size_t i = 0; i < 3; ++i) {
            EXPECT_TRUE(diffuse[i] >= 0 && diffuse[i] <= 1 && specular[i] >= 0 && specular[i] <= 1) << s.name;
            if constexpr (!std::is_same_v<TypeParam, Interface>) {
                EXPECT_TRUE(is_black(p.ambient)) << s.name;
                const float all = p.diffusion * (diffuse[i] + specular[i]) + p.reflexion * specular[i] +
                                  p.refraction * std::max(specular[i], diffuse[i]);
                EXPECT_LE(all, 1 + gamma(8)) << s.name;
            }
        }
    }
}

// Smooth things are what they are to every integrator.
TEST(Phong, OfSmoothMaterialsIsTheMaterialItself)
{
    for (const Place& p : places()) {
        const Glass glass{{0.9f, 0.5f, 0.1f}, 1.7f};
        const InterfaceBsdf bsdf(glass.phong(p.point), p.point.front);
        const auto there = glass.at(p.point).sample(p.wo, 0, {}),
                   through = glass.at(p.point).sample(p.wo, 0.999999f, {});
        ASSERT_TRUE(bsdf.only_delta());
        const auto reflection = bsdf.reflection(p.wo), refraction = bsdf.refraction(p.wo);
        ASSERT_TRUE(reflection);
        EXPECT_EQ(reflection->wi, there->wi);
        EXPECT_NEAR(reflection->weight.g, there->weight.g * there->pdf, 1e-7);
        ASSERT_EQ(refraction.has_value(), through->wi.z < 0);
        if (refraction) {
            EXPECT_EQ(refraction->wi, through->wi);
            EXPECT_NEAR(refraction->weight.g, through->weight.g * through->pdf, 1e-6);
        }
        const Mirror mirror{{0.9f, 0.5f, 0.1f}};
        EXPECT_EQ(InterfaceBsdf(mirror.phong(p.point), true).reflection(p.wo)->weight, (Color{0.9f, 0.5f, 0.1f}));
    }
}

// Roughness turns the mirror into a highlight; textures may bring any number.
TEST(Phong, OfMetalGoesFromMirrorToHighlight)
{
    const Color copper{0.95f, 0.64f, 0.54f};
    for (const float rough : {-1.0f, 0.0f, 0.001f, 0.25f, 1.0f, 7.0f}) {
        const Phong p = Metal{copper, rough}.phong({});
        const float part = rough < 0.01f ? 0 : std::min(1.0f, rough);
        EXPECT_EQ(p.diffusion, part);
        EXPECT_EQ(p.reflexion, 1 - part);
        EXPECT_EQ(p.specular, copper);
        EXPECT_TRUE(is_black(p.diffuse));
    }
    EXPECT_EQ(shininess_of(1), 0);
    EXPECT_NEAR(shininess_of(0.5f), 30, 1e-4);
}

// The coat of plastic is a mirror as far as it is smooth, and what it takes from the base is no more than it reflects.
TEST(Phong, OfPlasticHasACoatAndABase)
{
    const Color white{1, 1, 1};
    const Phong smooth = make_plastic(white, 0, 1.5f).phong({}), rough = make_plastic(white, 1, 1.5f).phong({});
    const float f0 = 0.04f;
    EXPECT_NEAR(InterfaceBsdf(smooth, true).reflection({0, 0, 1})->weight.g, f0 / (1 + f0), 1e-6);
    EXPECT_FALSE(InterfaceBsdf(rough, true).reflection({0, 0, 1}));
    EXPECT_NEAR(rough.diffusion * rough.diffuse.g, 1 - f0, 1e-6);
    EXPECT_NEAR(rough.diffusion * rough.specular.g, f0, 1e-6);
    for (const auto& p : {smooth, rough}) EXPECT_NEAR(InterfaceBsdf(p, true).reflectance().g, 1, 1e-6);
}

}  // namespace
}  // namespace lancer
