#include "io/mtl/material.h"

#include <algorithm>
#include <cmath>

#include "core/names.h"
#include "io/mtl/kind.h"
#include "scene/description/as_principled.h"

namespace lancer {
namespace {

constexpr Color grey{0.8f, 0.8f, 0.8f}, white{1, 1, 1};
constexpr float usual_roughness = 0.5f;  // of a coat or a metal of which nothing is said
constexpr float usual_ior = 1.5f;

// Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, section 5.2: the alpha whose
// highlight is about as wide as that of the Phong exponent. Roughness is its root.
float roughness_of_phong(float ns) { return std::sqrt(std::sqrt(2 / (ns + 2))); }

// For a Principled BSDF Blender writes 1000 (1 - roughness)^2.
float roughness_of_blender(float ns) { return std::max(0.0f, 1 - std::sqrt(ns / 1000)); }

class Describer {
public:
    Describer(const MtlEntry& entry, MtlFile& file, Diagnostics& diagnostics)
        : e_(entry), file_(file), diagnostics_(diagnostics)
    {
        m_.name = entry.name;
        m_.where = {file.path, entry.line, 0};
    }

    MaterialDescription describe()
    {
        describe_emission();
        const MtlDecision decision = decide_kind(e_);
        m_.why = decision.why, m_.is_doubtful = decision.doubtful;
        switch (decision.kind) {
            case MtlKind::physical:
                describe_physical();
                break;
            case MtlKind::glass:
                describe_glass();
                break;
            case MtlKind::metal:
                describe_metal_of_kd();
                break;
            case MtlKind::reflector:
                describe_reflector();
                break;
            case MtlKind::coated:
                describe_classic(), describe_coat();
                break;
            case MtlKind::matt:
                describe_classic();
                break;
        }
        describe_layers();
        describe_opacity();
        m_.bump_map = texture(MtlMapKind::bump, Encoding::linear, Channel::red);
        if (m_.bump_map) {
            const MtlMap& map = *e_.map(MtlMapKind::bump);
            m_.bump_scale = map.bump;
            m_.bump_map->may_be_normals = !map.channel;
        }
        m_.normal_map = texture(MtlMapKind::normal, Encoding::linear, Channel::color);
        m_.displacement_map = texture(MtlMapKind::disp, Encoding::linear, Channel::red);
        return std::move(m_);
    }

private:
    template <class Message>
    void warn(uint32_t line, const Message& message)
    {
        diagnostics_.warning({file_.path, line, 0}, message);
    }
    void not_used(MtlMapKind kind, const char* message)
    {
        if (const MtlMap* map = e_.map(kind)) warn(map->line, message);
    }

    // With what may be a comment behind the name, or without.
    FileFinder::Found find(const MtlMap& map)
    {
        if (!map.whole.empty())
            if (FileFinder::Found found = file_.finder.find(map.whole); !found.path.empty()) return found;
        return file_.finder.find(map.file);
    }

    TextureUse texture(MtlMapKind kind, Encoding encoding, Channel channel)
    {
        const MtlMap* const map = e_.map(kind);
        if (!map) return {};
        const FileFinder::Found found = find(*map);
        if (found.path.empty()) {
            const std::string problem = found.problem.empty() ? "not found" : found.problem;
            warn(map->line, NamedProblem{"texture file", map->file, " " + problem + "; not used"});
            return {};
        }
        if (found.other_folder)
            warn(map->line, NamedProblem{"texture file", map->file, " is not where its path says; its bare name is"});
        else if (found.other_case)
            warn(map->line, NamedProblem{"texture file", map->file, " not found; that name in other letters is used"});
        TextureDescription t;
        t.where = {file_.path, map->line, 0};
        t.file = found.path;
        t.use = {.encoding = map->encoding.value_or(encoding),
                 .channel = map->channel.value_or(channel),
                 .wrap = map->wrap,
                 .scale = map->scale,
                 .offset = map->offset,
                 .gain = map->gain,
                 .bias = map->base};
        return t;
    }

    void describe_emission()
    {
        if (e_.ke) m_.emission = e_.ke.value;
        if (e_.ke && is_black(m_.emission)) return not_used(MtlMapKind::ke, "map_Ke beside a black Ke emits nothing");
        m_.emission_map = texture(MtlMapKind::ke, Encoding::of_file, Channel::color);
        if (m_.emission_map && !e_.ke) m_.emission = white;
    }

    // The d of glass says that it is clear, not that rays pass without meeting it.
    void describe_opacity()
    {
        if (e_.d && e_.tr && std::abs(e_.d.value + e_.tr.value - 1) > 0.01f)
            warn(e_.tr.line, "d and Tr contradict each other; d is used");
        m_.opacity_map = texture(MtlMapKind::d, Encoding::linear, Channel::automatic);
        if (m_.type == MaterialType::glass || m_.transmission > 0) return;
        m_.opacity = stopped_part(e_);
        // A material with Tr 1 alone would not be seen at all; programs that write it mean the opposite.
        if (!e_.d && e_.tr.value == 1)
            warn(e_.tr.line, "Tr 1 without d would make the surface invisible; taken for opaque");
        if (m_.opacity > 0) return;
        if (e_.origin.program == MtlProgram::blender && !is_principled(e_) && !m_.opacity_map) {
            warn(e_.d.line, "d 0, which Blender before 2.80 wrote on what it showed, is taken for opaque");
            m_.opacity = 1;
        } else if (m_.opacity_map) {  // programs write it where they mean that the map decides
            warn(e_.d.line, "d 0 would make map_d invisible; the map alone is used");
            m_.opacity = 1;
        } else {
            warn(e_.d.line, "d 0 makes the surface invisible");
        }
    }

    // Kd with its texture: for all but glass, mirrors and metals of the classic keys.
    void describe_base()
    {
        m_.base_color_map = texture(MtlMapKind::kd, Encoding::of_file, Channel::color);
        // A lamp that says nothing of its own colour reflects nothing; any other material must be seen somehow.
        m_.base_color = m_.base_color_map ? white : is_black(m_.emission) ? grey : Color{};
        if (!e_.kd) return;
        // SketchUp writes the mean of the picture, which stands for it alone.
        if (m_.base_color_map && e_.origin.program == MtlProgram::sketchup) return;
        m_.base_color = e_.kd.value;
        if (!e_.map(MtlMapKind::kd) || !is_black(m_.base_color)) return;
        m_.base_color = m_.base_color_map ? white : grey;
        warn(e_.kd.line, "a black Kd would blacken map_Kd; white is used");
    }

    void describe_physical()
    {
        describe_base();
        m_.ior = coat_ior();
        if (is_principled(e_) && e_.ks) describe_specular_of_principled();
        describe_roughness();
        m_.metallic_map = texture(MtlMapKind::pm, Encoding::linear, Channel::red);
        m_.type = !m_.metallic_map && e_.pm.value >= 0.5f ? MaterialType::metal : MaterialType::plastic;
        if (m_.metallic_map) m_.metallic = e_.pm ? e_.pm.value : 1;
        not_used(MtlMapKind::ks, "map_Ks beside Pr or Pm ignored");
    }

    // What of the light comes through the whole object. Kd is its colour where it is one: programs write greys on all.
    Color transmittance() const
    {
        if (filters_light(e_)) return e_.tf.value;
        if (!e_.kd) return white;
        const Color kd = e_.kd.value;
        const float least = std::min({kd.r, kd.g, kd.b});
        constexpr float least_tint = 0.02f;  // greys of which one part was rounded are no colours
        return max_component(kd) - least > least_tint ? kd : white;
    }

    // Each ray crosses the surface twice.
    void describe_glass()
    {
        m_.type = MaterialType::glass;
        const Color through = transmittance();
        m_.base_color = {std::sqrt(through.r), std::sqrt(through.g), std::sqrt(through.b)};
        m_.ior = e_.ni ? e_.ni.value : usual_ior;
        m_.roughness_map = texture(MtlMapKind::pr, Encoding::linear, Channel::red);
        if (e_.pr || m_.roughness_map)
            m_.roughness = e_.pr ? e_.pr.value : 1;
        else if (e_.ns && e_.ns.value < 100)
            m_.roughness = roughness_of_exponent();
        not_used(MtlMapKind::kd, "map_Kd of glass ignored");
        not_used(MtlMapKind::ks, "map_Ks of glass ignored");
    }

    void describe_classic()
    {
        describe_base();
        not_used(MtlMapKind::ks, "map_Ks is used for mirrors and metals only; ignored");
    }

    void describe_metal_of_kd()
    {
        describe_classic();
        m_.type = MaterialType::metal;
        describe_roughness();
    }

    void describe_reflector()
    {
        m_.base_color_map = texture(MtlMapKind::ks, Encoding::of_file, Channel::color);
        m_.base_color = e_.ks ? e_.ks.value : m_.base_color_map ? white : grey;
        const bool perfect = e_.ns ? e_.ns.value >= 1000 : e_.origin.program != MtlProgram::keyshot;
        m_.type = perfect ? MaterialType::mirror : MaterialType::metal;
        if (!perfect) m_.roughness = e_.ns ? roughness_of_exponent() : usual_roughness;
    }

    void describe_roughness()
    {
        m_.roughness_map = texture(MtlMapKind::pr, Encoding::linear, Channel::red);
        m_.roughness = e_.pr ? e_.pr.value : m_.roughness_map ? 1 : e_.ns ? roughness_of_exponent() : usual_roughness;
    }

    // A number with its texture, which stands alone if there is no number.
    struct Weight {
        float value;
        TextureUse map;
    };
    Weight weight(const MtlValue<float>& number, MtlMapKind kind)
    {
        Weight w{number.value, {}};
        if (number && number.value == 0) return w;
        w.map = texture(kind, Encoding::linear, Channel::red);
        if (!number && w.map) w.value = 1;
        return w;
    }

    // Sheen, clear coat and anisotropy of the physical keys, in the sense of Blender's Principled BSDF.
    void describe_layers()
    {
        const Weight sheen = weight(e_.ps, MtlMapKind::ps), coat = weight(e_.pc, MtlMapKind::pc);
        const Weight brushed = weight(e_.aniso, MtlMapKind::aniso);
        if (!(sheen.value > 0 || coat.value > 0 || brushed.value > 0) || !as_principled(m_)) return;
        m_.fuzz = sheen.value, m_.fuzz_map = sheen.map;
        m_.coat = coat.value, m_.coat_map = coat.map;
        if (coat.value > 0) {
            const Weight rough = weight(e_.pcr, MtlMapKind::pcr);
            m_.coat_roughness = rough.value, m_.coat_roughness_map = rough.map;
            m_.coat_ior = usual_ior, m_.coat_darkening = 0;
        }
        if (!(brushed.value > 0)) return;
        // Disney's alphas are those of the roughness times and over the root of this.
        const float aspect = 1 - 0.9f * brushed.value;
        m_.anisotropy = 0.9f * brushed.value, m_.anisotropy_map = brushed.map;
        if (!m_.anisotropy_map)
            m_.roughness = std::min(1.0f, m_.roughness * std::sqrt(std::sqrt(0.5f * (aspect + 1 / aspect))));
        const Weight turned = weight(e_.anisor, MtlMapKind::anisor);
        m_.anisotropy_rotation = turned.value, m_.anisotropy_rotation_map = turned.map;
    }

    float roughness_of_exponent() const
    {
        return is_principled(e_) ? roughness_of_blender(e_.ns.value) : roughness_of_phong(e_.ns.value);
    }

    float coat_ior() const { return e_.ni.value > 1 ? e_.ni.value : usual_ior; }

    // Ks up to the reflectance F0 of the coat seen from the front is taken for a reflectance: 0.04 stands for the full
    // coat of an index of 1.5, half of it for half the coat. Above, it is the strength of a painted highlight, of which
    // programs write 0.5 for that same coat; more than the full coat there is not.
    void describe_coat()
    {
        m_.type = MaterialType::plastic;
        m_.ior = coat_ior();
        m_.roughness = e_.ns ? roughness_of_exponent() : usual_roughness;
        if (is_principled(e_)) return describe_specular_of_principled();
        m_.specular = e_.ks.value / std::max(max_component(e_.ks.value), f0_of_ior(m_.ior));
    }

    static float f0_of_ior(float ior)
    {
        const float amplitude = (ior - 1) / (ior + 1);
        return amplitude * amplitude;
    }

    // Blender writes the socket "Specular" as Ks. Cycles takes 0.08 times it for F0; since version 4, where the socket
    // is called "Specular IOR Level", twice it times the F0 of the index.
    void describe_specular_of_principled()
    {
        constexpr float most = 0.99f;
        const float ks = max_component(e_.ks.value);
        const float f0 = std::min(most, e_.origin.version < 4 ? 0.08f * ks : 2 * ks * f0_of_ior(coat_ior()));
        m_.ior = (1 + std::sqrt(f0)) / (1 - std::sqrt(f0));
    }

    const MtlEntry& e_;
    MtlFile& file_;
    Diagnostics& diagnostics_;
    MaterialDescription m_;
};

}  // namespace

MaterialDescription describe_mtl(const MtlEntry& entry, MtlFile& file, Diagnostics& diagnostics)
{
    return Describer(entry, file, diagnostics).describe();
}

}  // namespace lancer
