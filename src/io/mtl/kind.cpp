#include "io/mtl/kind.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace lancer {
namespace {

// Files write 0.01 where they mean that nothing is scattered.
constexpr float darkest_seen = 0.02f;
// What scatters more than this is seen, and is no glass unless something else says so.
constexpr float darkest_opaque = 0.05f;
// An index this near to 1 is that of air: nothing is refracted.
constexpr float least_refraction = 0.01f;

// A key with its number, as messages show it.
std::string key_text(const char* key, float value)
{
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%s %.3g", key, static_cast<double>(value));
    return text.data();
}
std::string illum_text(const MtlEntry& e) { return "illum " + std::to_string(e.illum.value); }

bool illum_is(const MtlEntry& e, std::initializer_list<int> models)
{
    return e.illum && std::find(models.begin(), models.end(), e.illum.value) != models.end();
}

bool refracts(const MtlEntry& e) { return e.ni && std::abs(e.ni.value - 1) > least_refraction; }
bool is_black_or_absent(const MtlValue<Color>& c) { return !c || is_black(c.value); }

bool is_seen(const MtlEntry& e)
{
    return e.map(MtlMapKind::kd) || (e.kd && max_component(e.kd.value) > darkest_opaque);
}

bool has_physical_keys(const MtlEntry& e) { return e.pr || e.pm || e.map(MtlMapKind::pr) || e.map(MtlMapKind::pm); }

// Beside a model of glass Tr 1 is meant as it is written.
bool says_see_through(const MtlEntry& e) { return e.d ? e.d.value < 1 : e.tr && e.tr.value > 0; }

std::string see_through_key(const MtlEntry& e) { return e.d ? key_text("d", e.d.value) : key_text("Tr", e.tr.value); }

// Why it is glass; empty if nothing but illum says so.
std::string evidence_of_glass(const MtlEntry& e)
{
    if (is_principled(e) && e.tf && max_component(e.tf.value) >= 0.5f)
        return "Tf, which Blender writes for transmission only";
    if (!illum_is(e, {4, 6, 7, 9})) return {};
    const std::string model = illum_text(e) + " and ";
    if (says_see_through(e)) return model + see_through_key(e);
    if (filters_light(e)) return model + "a Tf that is neither black nor white";
    if (is_black_or_absent(e.kd) && !e.map(MtlMapKind::kd) && refracts(e) && e.ni.value > 1)
        return model + key_text("Ni", e.ni.value) + " without Kd";
    return {};
}

// What speaks against illum 4, 6, 7 or 9; empty if nothing does.
std::string evidence_against_glass(const MtlEntry& e)
{
    if (!e.ni) return "Ni is missing";
    if (!refracts(e)) return key_text("Ni is", e.ni.value);
    if (is_seen(e)) return e.map(MtlMapKind::kd) ? "map_Kd is opaque" : "Kd is opaque";
    return {};
}

// Without Pm, Blender says by illum 3 that there is metal, and by Ka how much.
bool is_metal_of_kd(const MtlEntry& e)
{
    return is_principled(e) && illum_is(e, {3}) && !e.pm && (!e.ka || max_component(e.ka.value) >= 0.5f);
}

bool has_no_coat(const MtlEntry& e)
{
    return is_principled(e) && e.ks && is_black(e.ks.value) && !e.map(MtlMapKind::pm) && !e.map(MtlMapKind::ks);
}

// KeyShot writes no illum. It gives Ks to plastics as well, but what scatters nothing is a metal.
bool is_metal_of_ks(const MtlEntry& e)
{
    return e.origin.program == MtlProgram::keyshot && e.kd && is_black(e.kd.value) && !e.map(MtlMapKind::kd) &&
           !is_black_or_absent(e.ks);
}

bool is_reflector(const MtlEntry& e)
{
    if (is_principled(e)) return false;
    const bool reflects = (e.ks && !is_black(e.ks.value)) || (!e.ks && e.map(MtlMapKind::ks));
    const bool scatters = (e.kd && max_component(e.kd.value) > darkest_seen) || e.map(MtlMapKind::kd);
    return reflects && illum_is(e, {3, 5, 8}) && !scatters;
}

MtlDecision decide_opaque(const MtlEntry& e)
{
    if (is_metal_of_kd(e)) return {MtlKind::metal, "illum 3, which Blender writes for metals"};
    if (has_no_coat(e)) return {MtlKind::matt, "Ks of 0, which Blender writes for what has no coat"};
    if (has_physical_keys(e)) return {MtlKind::physical, "Pr or Pm"};
    if (is_metal_of_ks(e)) return {MtlKind::reflector, "Ks and a black Kd, which KeyShot writes for metals"};
    if (is_reflector(e)) return {MtlKind::reflector, illum_text(e) + " and Ks without Kd"};
    if (e.origin.program == MtlProgram::sketchup && !e.ns)
        return {MtlKind::matt, "Kd; SketchUp writes the same Ks for all"};
    if (e.ks && !is_black(e.ks.value)) return {MtlKind::coated, "Ks"};
    return {MtlKind::matt, e.kd || e.map(MtlMapKind::kd) ? "Kd alone" : "no key of another kind"};
}

}  // namespace

bool is_principled(const MtlEntry& e)
{
    return e.origin.program == MtlProgram::blender && (e.origin.version >= 3 || refracts(e));
}

float stopped_part(const MtlEntry& e)
{
    if (e.d) return e.d.value;
    return e.tr && e.tr.value < 1 ? 1 - e.tr.value : 1;
}

bool filters_light(const MtlEntry& e)
{
    if (!e.tf || is_principled(e)) return false;
    const float least = std::min({e.tf.value.r, e.tf.value.g, e.tf.value.b});
    return !is_black(e.tf.value) && least < 1;
}

MtlDecision decide_kind(const MtlEntry& e)
{
    if (e.pm.value >= 0.5f || e.map(MtlMapKind::pm)) return {MtlKind::physical, e.pm ? "Pm" : "map_Pm"};
    if (std::string why = evidence_of_glass(e); !why.empty()) return {MtlKind::glass, std::move(why)};
    if (illum_is(e, {4, 6, 7, 9})) {
        const std::string against = evidence_against_glass(e);
        if (against.empty()) return {MtlKind::glass, illum_text(e)};
        MtlDecision opaque = decide_opaque(e);
        opaque.why += "; " + illum_text(e) + " says glass, but " + against;
        opaque.doubtful = true;
        return opaque;
    }
    if (stopped_part(e) < 1 && e.ni.value > 1 + least_refraction && !e.map(MtlMapKind::d) && !has_physical_keys(e))
        return {MtlKind::glass, see_through_key(e) + " and " + key_text("Ni", e.ni.value)};
    return decide_opaque(e);
}

}  // namespace lancer
