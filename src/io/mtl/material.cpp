#include "io/mtl/material.h"

#include <algorithm>
#include <cmath>

#include "core/names.h"

namespace lancer {
namespace {

constexpr Color grey{0.8f, 0.8f, 0.8f}, white{1, 1, 1};
constexpr float usual_roughness = 0.5f;  // of a coat or a metal of which nothing is said
constexpr float usual_ior = 1.5f;

// Files write 0.01 where they mean that nothing is scattered.
bool is_dark(const MtlValue<Color>& c) { return !c || max_component(c.value) <= 0.02f; }

// Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, section 5.2: the alpha whose
// highlight is about as wide as that of the Phong exponent. Roughness is its root.
float roughness_of_exponent(float ns) { return std::sqrt(std::sqrt(2 / (ns + 2))); }

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
        const float stopped = dissolve();
        if (e_.pr || e_.pm || e_.map(MtlMapKind::pr) || e_.map(MtlMapKind::pm))
            describe_pbr();
        else if (is_glass(stopped))
            describe_glass();
        else
            describe_classic();
        // The d of glass says that it is clear, not that rays pass without meeting it.
        m_.opacity = m_.type == MaterialType::glass ? 1 : stopped;
        m_.opacity_map = texture(MtlMapKind::d, Encoding::linear, Channel::automatic);
        if (m_.opacity == 0) warn(e_.d ? e_.d.line : e_.tr.line, "d 0 makes the surface invisible");
        m_.bump_map = texture(MtlMapKind::bump, Encoding::linear, Channel::red);
        if (m_.bump_map) m_.bump_scale = e_.map(MtlMapKind::bump)->bump;
        m_.normal_map = texture(MtlMapKind::normal, Encoding::linear, Channel::color);
        return std::move(m_);
    }

private:
    void warn(uint32_t line, const std::string& message) { diagnostics_.warning({file_.path, line, 0}, message); }
    void not_used(MtlMapKind kind, const char* message)
    {
        if (const MtlMap* map = e_.map(kind)) warn(map->line, message);
    }

    TextureUse texture(MtlMapKind kind, Encoding encoding, Channel channel)
    {
        const MtlMap* const map = e_.map(kind);
        if (!map) return {};
        const FileFinder::Found found = file_.finder.find(map->file);
        if (found.path.empty()) {
            warn_missing(*map, found.problem);
            return {};
        }
        if (found.other_case)
            warn(map->line,
                 "texture file " + in_quotes(map->file) + " not found; " + in_quotes(found.path) + " is used");
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

    void warn_missing(const MtlMap& map, const std::string& problem)
    {
        constexpr uint64_t most_named = 10;
        if (++file_.missing_textures > most_named) return warn(map.line, "other texture files not found; not used");
        const std::string name = "texture file " + in_quotes(map.file);
        warn(map.line, problem.empty() ? name + " not found; not used" : name + " " + problem + "; not used");
    }

    void describe_emission()
    {
        if (e_.ke) m_.emission = e_.ke.value;
        if (e_.ke && is_black(m_.emission)) return not_used(MtlMapKind::ke, "map_Ke beside a black Ke emits nothing");
        m_.emission_map = texture(MtlMapKind::ke, Encoding::srgb, Channel::color);
        if (m_.emission_map && !e_.ke) m_.emission = white;
    }

    // d, or what Tr says instead. A material with Tr 1 alone would not be seen at all; programs that write it mean the
    // opposite.
    float dissolve()
    {
        if (e_.d && e_.tr && std::abs(e_.d.value + e_.tr.value - 1) > 0.01f)
            warn(e_.tr.line, "d and Tr contradict each other; d is used");
        if (e_.d) return e_.d.value;
        if (!e_.tr) return 1;
        if (e_.tr.value < 1) return 1 - e_.tr.value;
        if (!says_glass()) warn(e_.tr.line, "Tr 1 without d would make the surface invisible; taken for opaque");
        return 1;
    }

    bool illum_is(std::initializer_list<int> models) const
    {
        return e_.illum && std::find(models.begin(), models.end(), e_.illum.value) != models.end();
    }
    bool says_glass() const { return illum_is({4, 6, 7, 9}); }
    bool is_glass(float stopped) const
    {
        return says_glass() || (stopped < 1 && e_.ni.value > 1 && !e_.map(MtlMapKind::d));
    }

    // Kd with its texture: for all but glass, mirrors and metals of the classic keys.
    void describe_base()
    {
        m_.base_color_map = texture(MtlMapKind::kd, Encoding::srgb, Channel::color);
        // A lamp that says nothing of its own colour reflects nothing; any other material must be seen somehow.
        m_.base_color = m_.base_color_map ? white : is_black(m_.emission) ? grey : Color{};
        if (!e_.kd) return;
        m_.base_color = e_.kd.value;
        if (!m_.base_color_map || !is_black(m_.base_color)) return;
        m_.base_color = white;
        warn(e_.kd.line, "a black Kd would blacken map_Kd; white is used");
    }

    void describe_pbr()
    {
        describe_base();
        m_.ior = coat_ior();
        m_.roughness_map = texture(MtlMapKind::pr, Encoding::linear, Channel::red);
        m_.roughness = e_.pr              ? e_.pr.value
                       : m_.roughness_map ? 1
                       : e_.ns            ? roughness_of_exponent(e_.ns.value)
                                          : usual_roughness;
        m_.metallic_map = texture(MtlMapKind::pm, Encoding::linear, Channel::red);
        m_.type = !m_.metallic_map && e_.pm.value >= 0.5f ? MaterialType::metal : MaterialType::plastic;
        if (m_.metallic_map) m_.metallic = e_.pm ? e_.pm.value : 1;
        not_used(MtlMapKind::ks, "map_Ks beside Pr or Pm ignored");
    }

    // Tf is what of the light comes through the whole object, and each ray crosses its surface twice.
    void describe_glass()
    {
        m_.type = MaterialType::glass;
        m_.base_color = white;
        if (e_.tf && !is_black(e_.tf.value))
            m_.base_color = {std::sqrt(e_.tf.value.r), std::sqrt(e_.tf.value.g), std::sqrt(e_.tf.value.b)};
        m_.ior = e_.ni ? e_.ni.value : usual_ior;
        if (e_.ns && e_.ns.value < 100) m_.roughness = roughness_of_exponent(e_.ns.value);
        not_used(MtlMapKind::kd, "map_Kd of glass ignored");
        not_used(MtlMapKind::ks, "map_Ks of glass ignored");
    }

    void describe_classic()
    {
        const bool reflects = (e_.ks && !is_black(e_.ks.value)) || (!e_.ks && e_.map(MtlMapKind::ks));
        if (reflects && illum_is({3, 5, 8}) && is_dark(e_.kd) && !e_.map(MtlMapKind::kd)) return describe_metal();
        describe_base();
        not_used(MtlMapKind::ks, "map_Ks is used for mirrors and metals only; ignored");
        if (e_.ks && !is_black(e_.ks.value)) describe_coat();
    }

    void describe_metal()
    {
        m_.base_color_map = texture(MtlMapKind::ks, Encoding::srgb, Channel::color);
        m_.base_color = e_.ks ? e_.ks.value : m_.base_color_map ? white : grey;
        const bool perfect = !e_.ns || e_.ns.value >= 1000;
        m_.type = perfect ? MaterialType::mirror : MaterialType::metal;
        if (!perfect) m_.roughness = roughness_of_exponent(e_.ns.value);
    }

    float coat_ior() const { return e_.ni.value > 1 ? e_.ni.value : usual_ior; }

    // Ks up to the reflectance F0 of the coat seen from the front is taken for a reflectance: 0.04 stands for the full
    // coat of an index of 1.5, half of it for half the coat. Above, it is the strength of a painted highlight, of which
    // programs write 0.5 for that same coat; more than the full coat there is not.
    void describe_coat()
    {
        m_.type = MaterialType::plastic;
        m_.ior = coat_ior();
        m_.roughness = e_.ns ? roughness_of_exponent(e_.ns.value) : usual_roughness;
        const float amplitude = (m_.ior - 1) / (m_.ior + 1), f0 = amplitude * amplitude;
        m_.specular = e_.ks.value / std::max(max_component(e_.ks.value), f0);
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
