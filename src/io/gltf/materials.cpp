#include "io/gltf/materials.h"

#include <algorithm>
#include <cmath>

#include "scene/description/as_principled.h"

namespace lancer {
namespace {

Color color_of(const std::array<double, 3>& c)
{
    return {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])};
}
float in_unit(double x) { return static_cast<float>(std::clamp(x, 0.0, 1.0)); }
Color in_unit(Color c)
{
    const auto part = [](float x) { return std::clamp(x, 0.0f, 1.0f); };
    return {part(c.r), part(c.g), part(c.b)};
}
Color root_of(Color c) { return {std::sqrt(c.r), std::sqrt(c.g), std::sqrt(c.b)}; }

class MaterialReader {
public:
    MaterialReader(const JsonValue& json, GltfDocument& doc, GltfTextures& textures)
        : json_(json), doc_(doc), textures_(textures)
    {
        const std::string* const name = doc.text(json, "name");
        m_.name = name && !name->empty() ? *name : "material " + std::to_string(doc.number_of(json, "materials"));
        m_.where = {doc.path(), 0, 0};
        pbr_ = doc.object(json, "pbrMetallicRoughness");
        gloss_ = extension("KHR_materials_pbrSpecularGlossiness");
        const JsonValue* const base_of = gloss_ ? gloss_ : pbr_;
        base_info_ = textures.info(base_of, gloss_ ? "diffuseTexture" : "baseColorTexture");
        factor_ = base_of ? doc.numbers<4>(*base_of, gloss_ ? "diffuseFactor" : "baseColorFactor").value_or(factor_)
                          : factor_;
    }

    GltfMaterial read()
    {
        choose_coordinates();
        m_.base_color = in_unit(color_of({factor_[0], factor_[1], factor_[2]}));
        m_.base_color_map = use(base_info_, Encoding::of_file, Channel::color);
        describe_emission();
        if (extension("KHR_materials_unlit"))
            describe_unlit();
        else if (gloss_)
            describe_glossiness();
        else
            describe_metallic();
        if (!extension("KHR_materials_unlit")) describe_layers();
        describe_opacity();
        describe_normals();
        return std::move(made_);
    }

private:
    const JsonValue* extension(std::string_view name) const { return doc_.extension(json_, name); }
    double number(const JsonValue* of, std::string_view key, double usual) const
    {
        return of ? doc_.number(*of, key).value_or(usual) : usual;
    }

    // Two sets of texture coordinates serve a material, the first one being that of its colour if that has a texture. A
    // rotation that all textures of a set share is one of the coordinates themselves.
    void choose_coordinates()
    {
        std::vector<GltfTextureInfo> all{base_info_};
        for (const char* key : {"metallicRoughnessTexture"}) all.push_back(textures_.info(pbr_, key));
        all.push_back(textures_.info(gloss_, "specularGlossinessTexture"));
        all.push_back(textures_.info(&json_, "normalTexture"));
        all.push_back(textures_.info(&json_, "emissiveTexture"));
        std::erase_if(all, [](const GltfTextureInfo& i) { return !i.json; });
        for (const GltfTextureInfo& i : all) {
            auto& [first, second] = made_.uv_sets;
            if (!first) first = i.set;
            if (i.set != first && !second) second = i.set;
        }
        for (size_t k = 0; k < 2; ++k) {
            const auto is_of_set = [&](const GltfTextureInfo& i) { return i.set == made_.uv_sets[k]; };
            const auto first = std::find_if(all.begin(), all.end(), is_of_set);
            if (first == all.end() || first->transform.rotation == 0) continue;
            const bool is_shared = std::all_of(all.begin(), all.end(), [&](const GltfTextureInfo& i) {
                return !is_of_set(i) || i.transform == first->transform;
            });
            if (is_shared) made_.uv_transforms[k] = first->transform;
        }
    }

    TextureUse use(const GltfTextureInfo& info, Encoding encoding, Channel channel)
    {
        if (!info.json) return {};
        const bool is_second = info.set != made_.uv_sets[0];
        if (is_second && info.set != made_.uv_sets[1]) {
            doc_.warn(*info.json, "a texture of a third set of texture coordinates of its material; not used");
            return {};
        }
        TextureUse t = textures_.use(info, encoding, channel);
        if (!t) return t;
        t->use.by_second_uv = is_second;
        if (made_.uv_transforms[is_second ? 1 : 0]) return t;
        const GltfUvTransform& moved = info.transform;
        if (moved.rotation != 0)
            doc_.warn(*info.json, "the rotation of a texture that others of its material do not share is not used");
        // v points up here, down there.
        t->use.scale = {static_cast<float>(moved.scale.x), static_cast<float>(moved.scale.y)};
        t->use.offset = {static_cast<float>(moved.offset.x), static_cast<float>(1 - moved.offset.y - moved.scale.y)};
        return t;
    }

    void describe_emission()
    {
        const auto factor = doc_.numbers<3>(json_, "emissiveFactor");
        if (!factor) return;
        const double strength = number(extension("KHR_materials_emissive_strength"), "emissiveStrength", 1);
        const Color c = color_of(*factor) * static_cast<float>(strength);
        if (!is_finite(c) || std::min({c.r, c.g, c.b}) < 0) doc_.fail(json_, "the emission is not positive and finite");
        if (is_black(c)) return;
        m_.emission = c;
        m_.emission_map = use(textures_.info(&json_, "emissiveTexture"), Encoding::of_file, Channel::color);
        m_.emission_both_sides = doc_.flag(json_, "doubleSided");
    }

    void describe_unlit()
    {
        m_.type = MaterialType::lambert;
        m_.emission = m_.base_color;
        m_.emission_map = m_.base_color_map;
        m_.emission_both_sides = true;
        m_.base_color = {};
        m_.base_color_map.reset();
    }

    float ior() const
    {
        constexpr double usual = 1.5;
        const double said = number(extension("KHR_materials_ior"), "ior", usual);
        return static_cast<float>(said >= 1 && said < 100 ? said : usual);
    }

    void describe_metallic()
    {
        const GltfTextureInfo both = textures_.info(pbr_, "metallicRoughnessTexture");
        m_.roughness = in_unit(number(pbr_, "roughnessFactor", 1));
        m_.roughness_map = use(both, Encoding::linear, Channel::green);
        const float metallic = in_unit(number(pbr_, "metallicFactor", 1));
        if (metallic > 0 && is_partly_clear()) m_.metallic_map = use(both, Encoding::linear, Channel::blue);
        if (describe_transmission(metallic)) return;
        if (metallic > 0) m_.metallic_map = use(both, Encoding::linear, Channel::blue);
        if (metallic == 1 && !m_.metallic_map) {
            m_.type = MaterialType::metal;
            return;
        }
        m_.metallic = metallic;
        describe_dielectric(ior());
        describe_specular();
    }

    // An index of 1 has no reflection that a coat could have.
    void describe_dielectric(float index)
    {
        m_.type = MaterialType::plastic;
        m_.ior = std::max(index, 1.001f);
    }

    void describe_specular()
    {
        const JsonValue* const specular = extension("KHR_materials_specular");
        if (!specular) return;
        const double factor = number(specular, "specularFactor", 1);
        const Color c = color_of(doc_.numbers<3>(*specular, "specularColorFactor").value_or(std::array{1.0, 1.0, 1.0}));
        const Color tint = c * static_cast<float>(factor);
        if (max_component(tint) > 1) doc_.warn(*specular, "a specular colour above 1 is cut off");
        m_.specular = in_unit(tint);
        for (const char* key : {"specularTexture", "specularColorTexture"})
            if (doc_.object(*specular, key))
                doc_.warn(*specular, std::string(key) + " is not used: the factor alone is");
    }

    const JsonValue* transmission() const { return extension("KHR_materials_transmission"); }
    // What lets a part of the light through, is principled; what lets all through, is glass.
    bool is_partly_clear() const
    {
        const double factor = number(transmission(), "transmissionFactor", 0);
        return factor > 0 && (factor < 1 || doc_.object(*transmission(), "transmissionTexture"));
    }
    bool describe_transmission(float metallic)
    {
        const double factor = number(transmission(), "transmissionFactor", 0);
        if (!(factor > 0)) return false;
        const Color tint = root_of(m_.base_color);  // light crosses two faces
        m_.ior = ior();
        if (is_partly_clear()) {
            m_.type = MaterialType::plastic;
            m_.metallic = metallic;
            describe_dielectric(m_.ior);
            describe_specular();
            as_principled(m_);
            m_.transmission = in_unit(factor);
            m_.transmission_map =
                use(textures_.info(transmission(), "transmissionTexture"), Encoding::linear, Channel::red);
            m_.transmittance = tint, m_.transmittance_map = m_.base_color_map;
        } else {
            m_.type = MaterialType::glass;
            m_.base_color = tint;
        }
        const JsonValue* const volume = extension("KHR_materials_volume");
        m_.thin = !volume || number(volume, "thicknessFactor", 0) <= 0;
        if (!*m_.thin) describe_volume(*volume);
        return true;
    }

    // Of the light that distance leaves the colour.
    void describe_volume(const JsonValue& volume)
    {
        const auto color = doc_.numbers<3>(volume, "attenuationColor");
        const double distance = number(&volume, "attenuationDistance", 0);
        if (!color || !(distance > 0)) return;
        constexpr double darkest = 1e-6;
        const auto absorbed = [&](double left) {
            return static_cast<float>(std::min(-std::log(std::clamp(left, darkest, 1.0)) / distance, 1e30));
        };
        m_.absorption = {absorbed((*color)[0]), absorbed((*color)[1]), absorbed((*color)[2])};
        describe_scattering();
    }

    // What leaves a ray is not only absorbed: the colour is that of a thick body.
    void describe_scattering()
    {
        const JsonValue* const scatter = extension("KHR_materials_volume_scatter");
        if (!scatter) return;
        const auto multiple = doc_.numbers<3>(*scatter, "multiscatterColor");
        if (!multiple || is_black(color_of(*multiple))) return;
        static constexpr float clearest = 1e-6f;  // of the extinction, per unit of length
        const auto path = [](float extinction) { return 1 / std::max(clearest, extinction); };
        m_.subsurface_color = in_unit(color_of(*multiple));
        m_.subsurface_radius = {path(m_.absorption.r), path(m_.absorption.g), path(m_.absorption.b)};
        m_.absorption = {};
        constexpr double most = 0.999;
        m_.scattering_anisotropy = static_cast<float>(std::clamp(number(scatter, "scatterAnisotropy", 0), -most, most));
    }

    // The diffuse colour is that of plastic. Its coat gets the index that reflects as much from the front as the
    // specular colour says; what reflects more than a stone can is metal.
    void describe_glossiness()
    {
        constexpr float most_of_dielectrics = 0.2f;
        const GltfTextureInfo both = textures_.info(gloss_, "specularGlossinessTexture");
        const double glossiness = std::clamp(number(gloss_, "glossinessFactor", 1), 0.0, 1.0);
        Color specular =
            in_unit(color_of(doc_.numbers<3>(*gloss_, "specularFactor").value_or(std::array{1.0, 1.0, 1.0})));
        m_.roughness_map = use(both, Encoding::linear, Channel::alpha);
        m_.roughness = static_cast<float>(1 - glossiness);
        if (m_.roughness_map) {
            m_.roughness = 1;
            m_.roughness_map->use.gain = static_cast<float>(-glossiness), m_.roughness_map->use.bias = 1;
            doc_.warn(*both.json,
                      "the colours of a specular-glossiness texture are not used: its alpha alone is, and "
                      "0.04 is reflected from the front");
            specular = Color{0.04f, 0.04f, 0.04f};
        }
        const float f0 = max_component(specular);
        if (f0 > most_of_dielectrics && max_component(m_.base_color) <= f0) {
            m_.type = MaterialType::metal;
            m_.base_color = specular;
            m_.base_color_map.reset();
            return;
        }
        const float root = std::sqrt(std::min(f0, 0.9f));
        describe_dielectric((1 + root) / (1 - root));
        if (f0 > 0) m_.specular = specular / f0;
    }

    // Layers that no plainer material has. Of textures of directions the strength alone is used.
    void describe_layers() { describe_coat(), describe_sheen(), describe_anisotropy(), describe_iridescence(); }

    void describe_coat()
    {
        const JsonValue* const coat = extension("KHR_materials_clearcoat");
        const double strength = number(coat, "clearcoatFactor", 0);
        if (!(strength > 0) || !as_principled(m_)) return;
        m_.coat = in_unit(strength);
        m_.coat_map = use(textures_.info(coat, "clearcoatTexture"), Encoding::linear, Channel::red);
        m_.coat_roughness = in_unit(number(coat, "clearcoatRoughnessFactor", 0));
        m_.coat_roughness_map =
            use(textures_.info(coat, "clearcoatRoughnessTexture"), Encoding::linear, Channel::green);
        m_.coat_ior = 1.5f, m_.coat_darkening = 0;
        if (doc_.object(*coat, "clearcoatNormalTexture"))
            doc_.warn(*coat, "clearcoatNormalTexture is not used: a coat has the normals of its base");
    }

    void describe_sheen()
    {
        const JsonValue* const sheen = extension("KHR_materials_sheen");
        const auto color = sheen ? doc_.numbers<3>(*sheen, "sheenColorFactor") : std::nullopt;
        if (!color || is_black(color_of(*color)) || !as_principled(m_)) return;
        const Color tint = in_unit(color_of(*color));
        m_.fuzz = max_component(tint);
        m_.fuzz_color = tint / m_.fuzz;
        m_.fuzz_color_map = use(textures_.info(sheen, "sheenColorTexture"), Encoding::of_file, Channel::color);
        m_.fuzz_roughness = in_unit(number(sheen, "sheenRoughnessFactor", 0));
        m_.fuzz_roughness_map = use(textures_.info(sheen, "sheenRoughnessTexture"), Encoding::linear, Channel::alpha);
    }

    // Its wider alpha is that of the roughness and the strength, its narrower one that of the roughness.
    void describe_anisotropy()
    {
        const JsonValue* const brushed = extension("KHR_materials_anisotropy");
        const double strength = std::clamp(number(brushed, "anisotropyStrength", 0), 0.0, 1.0);
        if (!(strength > 0) || !as_principled(m_)) return;
        const double alpha = static_cast<double>(m_.roughness) * static_cast<double>(m_.roughness);
        const double wide = alpha + (1 - alpha) * strength * strength, aspect = wide > 0 ? alpha / wide : 1;
        m_.anisotropy = in_unit(1 - aspect);
        m_.anisotropy_map = use(textures_.info(brushed, "anisotropyTexture"), Encoding::linear, Channel::blue);
        m_.roughness = in_unit(std::sqrt(wide * std::sqrt((1 + aspect * aspect) / 2)));
        constexpr double turn = 6.283185307179586;
        const double turns = number(brushed, "anisotropyRotation", 0) / turn;
        m_.anisotropy_rotation = in_unit(turns - std::floor(turns));
        if (m_.anisotropy_map)
            doc_.warn(*brushed, "the directions of an anisotropyTexture are not used: its strength alone is");
    }

    void describe_iridescence()
    {
        const JsonValue* const film = extension("KHR_materials_iridescence");
        const double factor = number(film, "iridescenceFactor", 0);
        if (!(factor > 0) || !as_principled(m_)) return;
        const auto size = [&](std::string_view key, double usual) {
            return static_cast<float>(std::clamp(number(film, key, usual), 0.0, 1e5));
        };
        m_.film = in_unit(factor);
        m_.film_map = use(textures_.info(film, "iridescenceTexture"), Encoding::linear, Channel::red);
        m_.film_ior = std::max(1.0f, size("iridescenceIor", 1.3));
        m_.film_thickness = size("iridescenceThicknessMaximum", 400);
        m_.film_thickness_map =
            use(textures_.info(film, "iridescenceThicknessTexture"), Encoding::linear, Channel::green);
        if (!m_.film_thickness_map || !(m_.film_thickness > 0)) return;
        const float least = size("iridescenceThicknessMinimum", 100) / m_.film_thickness;
        m_.film_thickness_map->use.gain = 1 - least, m_.film_thickness_map->use.bias = least;
    }

    void describe_opacity()
    {
        const std::string* const mode = doc_.text(json_, "alphaMode");
        if (!mode || *mode == "OPAQUE" || m_.type == MaterialType::glass || m_.transmission == 1) return;
        const auto alpha = static_cast<float>(std::clamp(factor_[3], 0.0, 1.0));
        m_.opacity_map = use(base_info_, Encoding::linear, Channel::alpha);
        if (*mode == "MASK") {
            const double cutoff = number(&json_, "alphaCutoff", 0.5);
            if (!m_.opacity_map) {
                m_.opacity = static_cast<double>(alpha) >= cutoff ? 1.0f : 0.0f;
            } else {  // so steep that only what lies on the very edge is between 0 and 1
                constexpr double steep = 1e4;
                m_.opacity_map->use.gain = static_cast<float>(steep) * alpha;
                m_.opacity_map->use.bias = static_cast<float>(1 - steep * std::clamp(cutoff, -10.0, 10.0));
            }
        } else if (*mode == "BLEND") {
            m_.opacity = alpha;
        } else {
            doc_.warn(json_, "alphaMode is none of OPAQUE, MASK and BLEND; taken for OPAQUE");
            m_.opacity_map.reset();
            return;
        }
        made_.fades = *mode == "BLEND", made_.masks = *mode == "MASK";
    }

    void describe_normals()
    {
        const GltfTextureInfo info = textures_.info(&json_, "normalTexture");
        m_.normal_map = use(info, Encoding::linear, Channel::color);
        if (m_.normal_map && number(info.json, "scale", 1) != 1)
            doc_.warn(*info.json, "the scale of a normal texture is not used");
    }

    const JsonValue& json_;
    GltfDocument& doc_;
    GltfTextures& textures_;
    const JsonValue *pbr_ = nullptr, *gloss_ = nullptr;
    GltfTextureInfo base_info_;
    std::array<double, 4> factor_{1, 1, 1, 1};
    GltfMaterial made_;
    MaterialDescription& m_ = made_.description;
};

}  // namespace

GltfMaterial read_gltf_material(const JsonValue* material, GltfDocument& document, GltfTextures& textures)
{
    if (material) return MaterialReader(*material, document, textures).read();
    GltfMaterial usual;
    usual.description.name = "default", usual.description.where = {document.path(), 0, 0};
    return usual;
}

}  // namespace lancer
