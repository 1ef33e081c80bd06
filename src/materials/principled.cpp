#include "materials/principled.h"

namespace lancer {
namespace {

float in_unit(float x) { return std::min(1.0f, std::max(0.0f, x)); }

}  // namespace

PrincipledBsdf Principled::at(const ShadingPoint& p) const
{
    PrincipledBsdf b;
    b.material = this;
    b.front = p.front, b.media_eta = p.eta;
    b.base = p.base(base);
    b.metallic = in_unit(p.eval(metallic)), b.transmission = in_unit(p.eval(transmission));
    // Seen from inside of a body, coat and fuzz are on the far side; the base is as rough.
    const bool is_inside = !p.front && b.transmission > 0 && !tables->glass.thin;
    const float coated = in_unit(p.eval(coat));
    const float coat_alpha = coated > 0 && tables->coat ? alpha_of_roughness(p.eval(coat_roughness)) : 0;
    if (!is_inside) {
        b.coat = coated, b.coat_alpha = coat_alpha, b.fuzz = tables->fuzz ? in_unit(p.eval(fuzz)) : 0;
        if (b.fuzz > 0) b.fuzz_color = p.part(fuzz_color), b.fuzz_roughness = in_unit(p.eval(fuzz_roughness));
    }
    b.roughness = roughness_under_coat(in_unit(p.eval(roughness)), coated, coat_alpha > 0 ? std::sqrt(coat_alpha) : 0);
    b.anisotropy = anisotropy.value > 0 ? in_unit(p.eval(anisotropy)) : 0;
    b.alpha = alphas_of(b.roughness, b.anisotropy);
    if (!b.alpha.is_even()) b.turn(b.turn_of(p.tangent, p.eval(rotation)));
    b.film = in_unit(p.eval(film));
    if (b.film > 0) b.film_thickness = std::max(0.0f, p.eval(film_thickness));
    if (b.transmission > 0) b.transmittance = p.part(transmittance);
    b.finish();
    return b;
}

Vec2 PrincipledBsdf::turn_of(Vec2 tangent, float part) const
{
    const SinCos sc = sin_cos_2pi(in_unit(part));
    const float sin = front ? sc.sin : -sc.sin;
    return {tangent.x * sc.cos - tangent.y * sin, tangent.y * sc.cos + tangent.x * sin};
}
Vec2 PrincipledBsdf::turn_of(Vec2 tangent) const
{
    const float part = material->rotation.value;
    return part == 0 ? tangent : turn_of(tangent, part);
}

// Of its parts, each as the type of material that is like it.
Phong Principled::phong(const ShadingPoint& p) const
{
    const float rough = highlight_of(p.eval(roughness)), shininess = shininess_of(std::max(0.1f, rough));
    const float f0 = fresnel_dielectric(1.0f, tables->dielectric_ior).reflectance;
    const Color color = p.base(base);
    const float diffusion = 1 / (1 + f0 * (1 - rough));
    const Phong body{.diffuse = color * (1 - f0),
                     .specular = specular * f0,
                     .shininess = shininess,
                     .diffusion = diffusion,
                     .reflexion = diffusion * (1 - rough)};
    const Phong metal{
        .specular = color * specular_weight, .shininess = shininess, .diffusion = rough, .reflexion = 1 - rough};
    Phong dielectric = body;
    if (const float through = in_unit(p.eval(transmission)); through > 0) {
        Phong glass = tables->glass.phong(p);
        glass.diffuse *= p.eval(transmittance);
        dielectric = mix(through, body, glass);
    }
    Phong all = mix(in_unit(p.eval(metallic)), dielectric, metal);
    // Parts and colours are interpolated alike, so that their products may exceed all light.
    const auto sent = [&](float d, float s) {
        return all.diffusion * (d + s) + all.reflexion * s + all.refraction * std::max(d, s);
    };
    const float most = std::max({sent(all.diffuse.r, all.specular.r), sent(all.diffuse.g, all.specular.g),
                                 sent(all.diffuse.b, all.specular.b)});
    if (most > 1) all.diffusion /= most, all.reflexion /= most, all.refraction /= most;
    return all;
}

}  // namespace lancer
