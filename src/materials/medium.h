// Media inside transparent objects, which absorb and scatter, and the stack of media around a ray (nested dielectrics).
// Where objects overlap, the one with the highest priority is present, and the surfaces of the others are ignored.
// Schmidt and Budge, "Simple Nested Dielectrics in Ray Traced Images", Journal of Graphics Tools 7(2), 2002.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "core/color.h"
#include "materials/phase_function.h"

namespace lancer {

struct Medium {
    Color absorption{};                 // sigma_a per scene unit, >= 0
    float ior = 1;                      // without a priority: relative to the surroundings
    std::optional<int32_t> priority{};  // none: its surface is never ignored
    Color scattering{};                 // sigma_s per scene unit, >= 0
    HenyeyGreenstein phase{};
    // Its surface is of index 1 and clear, and is ignored where nothing bends light there: paths and shadow rays pass.
    bool is_bare = false;
    bool is_dense = false;  // free flights in it are short beside the scene
    bool is_dark = false;   // light samples from inside would all end at its surface, as no light is inside

    bool scatters() const { return !is_black(scattering); }
    Color extinction() const { return absorption + scattering; }
    // The part of what leaves the ray that is scattered, of each channel; 0 where nothing leaves it.
    Color albedo() const
    {
        const auto part = [](float s, float a) { return s > 0 ? s / (s + a) : 0; };
        return {part(scattering.r, absorption.r), part(scattering.g, absorption.g), part(scattering.b, absorption.b)};
    }
};

inline constexpr uint16_t no_medium = UINT16_MAX;

// Beer-Lambert transmittance over a distance in scene units: the part that is neither absorbed nor scattered.
inline Color transmittance(const Medium& medium, float distance)
{
    const auto part = [distance](float sigma) { return sigma > 0 ? std::exp(-sigma * distance) : 1; };
    const Color sigma = medium.extinction();
    return {part(sigma.r), part(sigma.g), part(sigma.b)};
}

// The stack of objects that a ray has entered and not left, as medium ids. It drops the oldest entry on overflow.
// Leaving an object that is not on the stack is ignored as if it had been entered first, so that dropped entries
// reappear.
class MediumStack {
public:
    static constexpr size_t capacity = 4;

    void enter(uint16_t id)
    {
        std::copy_backward(ids_.begin(), ids_.end() - 1, ids_.end());
        ids_[0] = id;
    }
    // Removes a medium; returns whether it was on the stack.
    bool leave(uint16_t id)
    {
        const auto at = std::find(ids_.begin(), ids_.end(), id);
        if (at == ids_.end()) return false;
        std::copy(at + 1, ids_.end(), at);
        ids_.back() = no_medium;
        return true;
    }
    // Inserts a medium as the oldest entry.
    void enter_first(uint16_t id)
    {
        const auto end = std::find(ids_.begin(), ids_.end(), no_medium);
        if (end != ids_.end()) *end = id;
    }

    struct Current {
        uint16_t id = no_medium;
        float ior = 1;  // relative to vacuum
    };
    // The present medium. Of equal priority the one entered first; a medium without priority is present from its
    // surface until another surface.
    Current current(std::span<const Medium> media) const
    {
        Current c;
        for (size_t i = capacity; i-- > 0;) {
            if (ids_[i] == no_medium) continue;
            const Medium& m = media[ids_[i]];
            if (c.id != no_medium && m.priority && media[c.id].priority && *m.priority <= *media[c.id].priority)
                continue;
            c = {ids_[i], m.priority ? m.ior : c.ior * m.ior};
        }
        return c;
    }

    friend bool operator==(const MediumStack&, const MediumStack&) = default;

private:
    std::array<uint16_t, capacity> ids_{no_medium, no_medium, no_medium, no_medium};  // most recent first
};

// The crossing of a surface from within `here`.
struct Boundary {
    MediumStack here, beyond;
    float eta = 0;        // relative index; 0: that of the material
    bool absent = false;  // the same medium on both sides, or nothing but media: the surface is ignored
};
// id: medium behind the surface, or none; front: the ray would enter it.
inline Boundary cross(std::span<const Medium> media, const MediumStack& in, uint16_t id, bool front)
{
    Boundary c{in, in};
    if (id == no_medium) return c;
    if (front)
        c.beyond.enter(id);
    else if (!c.beyond.leave(id))
        c.here.enter_first(id);
    const Medium& m = media[id];
    if (!m.priority) {
        c.absent = m.is_bare;
        return c;
    }
    const MediumStack::Current before = c.here.current(media), after = c.beyond.current(media);
    c.eta = after.ior / before.ior;
    c.absent = before.id == after.id || (m.is_bare && c.eta == 1);
    return c;
}

}  // namespace lancer
