// Where mirror and glass send light, by closed form.
#include <gtest/gtest.h>

#include "core/ray.h"
#include "materials/interface.h"
#include "materials/samples.h"

namespace lancer {
namespace {

TEST(Mirror, ReflectsExactly)
{
    for (const Place& p : places()) {
        const auto s = Mirror{{0.9f, 0.5f, 0.1f}}.at(p.point).sample(p.wo, 0.3f, {});
        ASSERT_TRUE(s);
        EXPECT_EQ(s->wi, (Vec3{-p.wo.x, -p.wo.y, p.wo.z}));
        EXPECT_EQ(s->weight, (Color{0.9f, 0.5f, 0.1f}));
        EXPECT_EQ(s->pdf, 1);
        EXPECT_EQ(s->eta, 1);
    }
}

TEST(Glass, ReflectsExactly)
{
    for (const Place& p : places()) {
        const auto s = Glass{{0.9f, 0.5f, 0.1f}, 1.5f}.at(p.point).sample(p.wo, 0, {});
        ASSERT_TRUE(s);
        EXPECT_EQ(s->wi, (Vec3{-p.wo.x, -p.wo.y, p.wo.z}));
        EXPECT_EQ(s->weight, (Color{0.9f, 0.5f, 0.1f}));
        EXPECT_EQ(s->pdf, fresnel_dielectric(p.wo, p.point.front ? 1.5 : 1 / 1.5).reflectance);
    }
}

// eta sin(theta_t) = sin(theta_i), in the plane of incidence, on the other side; also where theta_t is nearly a right
// angle. Radiance shrinks by eta^2.
TEST(Glass, RefractsBySnellsLaw)
{
    int refracted = 0;
    for (const float ior : {1.0f, 1.000001f, 1.0001f, 1.33f, 1.5f, 2.42f, 1000.0f, 0.75f, 0.001f})
        for (const bool front : {true, false})
            for (int i = 1; i <= 4000; ++i) {
                const double z = i / 4000.0, r = std::sqrt(1 - z * z), phi = 0.1 * i;
                const Vec3 wo = to_float(Vec3d{r * std::cos(phi), r * std::sin(phi), z});
                const auto s = Glass{{1, 1, 1}, ior}.at({.front = front}).sample(wo, 1 - 0x1p-24f, {});
                ASSERT_TRUE(s);
                if (s->wi.z > 0) continue;
                ++refracted;
                const double eta = front ? static_cast<double>(ior) : 1 / static_cast<double>(ior);
                EXPECT_NEAR(s->eta, eta, 1e-7 * eta);
                EXPECT_NEAR(s->weight.g, 1 / (eta * eta), 4e-7 / (eta * eta));
                const double sin_t = std::hypot(static_cast<double>(s->wi.x), static_cast<double>(s->wi.y));
                ASSERT_NEAR(eta * sin_t, r, 1e-6 * std::max(1.0, eta)) << ior << " " << z;
                // cos_t, too, is what Snell says: sin_t alone tells nothing near a right angle.
                const double cos_t = std::sqrt(std::max(0.0, 1 - r * r / (eta * eta)));
                ASSERT_NEAR(-static_cast<double>(s->wi.z) * cos_t, cos_t * cos_t, 1e-6 * std::max(1.0, 1 / (eta * eta)))
                    << ior << " " << z;
                ASSERT_NEAR(s->wi.x * wo.y, s->wi.y * wo.x, 1e-7);
                ASSERT_LE(s->wi.x * wo.x + s->wi.y * wo.y, 0);
            }
    EXPECT_GT(refracted, 30000);
}

TEST(Glass, ReflectsTotallyBeyondTheCriticalAngle)
{
    const auto inside = Glass{{1, 1, 1}, 1.5f}.at({.front = false});
    const float critical = std::sqrt(1 - 1 / (1.5f * 1.5f));
    for (const float u : {0.0f, 0.5f, 1 - 0x1p-24f})
        for (const float z : {critical - 1e-6f, 0.5f * critical, 1e-7f}) {
            const auto s = inside.sample({std::sqrt(1 - z * z), 0, z}, u, {});
            ASSERT_TRUE(s);
            EXPECT_EQ(s->wi.z, z);
            EXPECT_EQ(s->pdf, 1);
        }
    EXPECT_LT(inside.sample({std::sqrt(1 - critical * critical), 0, critical + 1e-5f}, 1 - 0x1p-24f, {})->wi.z, 0);
}

// Without Fresnel all light goes through, whatever number asks; but what is reflected totally has no other way.
TEST(Glass, WithoutFresnelOnlyRefracts)
{
    const float critical = std::sqrt(1 - 1 / (1.5f * 1.5f));
    for (const bool front : {true, false}) {
        const auto glass = Glass{.tint = {0.9f, 0.5f, 0.1f}, .ior = 1.5f, .fresnel = false}.at({.front = front});
        const InterfaceBsdf face({.diffuse = {0.9f, 0.5f, 0.1f},
                                  .specular = {1, 1, 1},
                                  .diffusion = 0,
                                  .reflexion = 0.3f,
                                  .refraction = 0.7f,
                                  .inside_ior = 1.5f},
                                 front, false);
        const float eta = front ? 1.5f : 1 / 1.5f;
        for (const float u : {0.0f, 0.02f, 0.5f, 1 - 0x1p-24f})
            for (const float z : {1.0f, critical + 1e-5f}) {
                const Vec3 wo{std::sqrt(1 - z * z), 0, z};
                for (const auto& s : {glass.sample(wo, u, {}), face.sample(wo, u, {})}) {
                    ASSERT_TRUE(s);
                    EXPECT_LT(s->wi.z, 0);
                    EXPECT_EQ(s->pdf, 1);
                    EXPECT_NEAR(s->weight.g, 0.5f / (eta * eta), 1e-6f);
                }
                EXPECT_FALSE(face.reflection(wo));
            }
        if (front) continue;
        const Vec3 grazing{std::sqrt(1 - 0.25f * critical * critical), 0, 0.5f * critical};
        for (const auto& s : {glass.sample(grazing, 0.9f, {}), face.sample(grazing, 0.9f, {})}) {
            ASSERT_TRUE(s);
            EXPECT_EQ(s->wi.z, grazing.z);
            EXPECT_EQ(s->pdf, 1);
        }
        EXPECT_FALSE(face.refraction(grazing));
    }
}

// A boundary that is none changes nothing, not even the last bit that counts.
TEST(Glass, OfIndexOneIsNotThere)
{
    for (const Place& p : places())
        for (const float u : {0.0f, 0.5f, 1 - 0x1p-24f}) {
            const auto s = Glass{{1, 1, 1}, 1}.at(p.point).sample(p.wo, u, {});
            ASSERT_TRUE(s);
            EXPECT_LE(length(s->wi + p.wo), gamma(4)) << p.name;
            EXPECT_EQ(s->weight, (Color{1, 1, 1}));
            EXPECT_EQ(s->pdf, 1);
        }
    const auto grazing = Glass{{1, 1, 1}, 1}.at({}).sample({1, 0, 1e-20f}, 0.5f, {});
    ASSERT_TRUE(grazing);
    EXPECT_LT(grazing->wi.z, 0);
}

}  // namespace
}  // namespace lancer
