// Media inside transparent objects, which absorb and scatter, and the stack of media around a ray (nested dielectrics).
// Where objects overlap, the one with the highest priority is present, and the surfaces of the others are ignored.
// Schmidt and Budge, "Simple Nested Dielectrics in Ray Traced Images", Journal of Graphics Tools 7(2), 2002.
#pragma once

#include <algorithm>
#include <bit>
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

// The list of objects that a ray has entered and not left, as medium ids, in 64 bits: as many bits for each id as the
// scene's media need. An object that finds no place is not tracked: its surface is ignored both ways. So each surface
// goes on from the index at which the one before it ended, in whatever order objects are entered and left, and no light
// is lost or gained. Leaving an object that was never entered counts as if it had been entered first.
class MediumStack {
    using Media = std::span<const Medium>;
    static constexpr int listed_bits = 60;
    static constexpr uint64_t one_untracked = uint64_t{1} << listed_bits, many_untracked = 15 * one_untracked;

public:
    // How many objects are told apart: 60 of one medium, 15 of up to 15 media, 7 of up to 255, at least 3.
    static size_t capacity(Media media) { return static_cast<size_t>(listed_bits / width(media)); }

    // Returns whether there was a place.
    bool enter(Media media, uint16_t id)
    {
        if (is_full(media)) {
            if (bits_ < many_untracked) bits_ += one_untracked;
            return false;
        }
        list((listed() << width(media)) | entry(id));
        return true;
    }
    // Removes the most recent entry of a medium; returns whether there was one.
    bool leave(Media media, uint16_t id)
    {
        const int w = width(media);
        const int none = end(w);
        int at = 0;
        while (at < none && entry_at(at, w) != entry(id)) at += w;
        if (at == none) return false;
        list((listed() >> (at + w) << at) | (listed() & ((uint64_t{1} << at) - 1)));
        return true;
    }
    // Leaves an untracked object; returns whether there was one. Beyond the largest count there always is.
    bool leave_untracked()
    {
        if (bits_ < one_untracked) return false;
        if (bits_ < many_untracked) bits_ -= one_untracked;
        return true;
    }
    // Inserts a medium as the oldest entry, if there is a place.
    void enter_first(Media media, uint16_t id)
    {
        if (!is_full(media)) list(listed() | entry(id) << end(width(media)));
    }

    struct Current {
        uint16_t id = no_medium;
        float ior = 1;  // relative to vacuum
    };
    // The present medium. Of equal priority the one entered first; a medium without priority is present from its
    // surface until another surface.
    Current current(Media media) const
    {
        Current c;
        const int w = width(media);
        for (int at = end(w); at > 0;) {
            at -= w;
            const auto id = static_cast<uint16_t>(entry_at(at, w) - 1);
            const Medium& m = media[id];
            if (c.id != no_medium && m.priority && media[c.id].priority && *m.priority <= *media[c.id].priority)
                continue;
            c = {id, m.priority ? m.ior : c.ior * m.ior};
        }
        return c;
    }

    friend bool operator==(const MediumStack&, const MediumStack&) = default;

private:
    static int bits_of(uint64_t x) { return static_cast<int>(std::bit_width(x)); }
    // Bits of an entry, which is an id and 1: no entry is 0.
    static int width(Media media) { return bits_of(media.size() | 1); }
    static uint64_t entry(uint16_t id) { return uint64_t{id} + 1; }
    uint64_t entry_at(int at, int w) const { return (listed() >> at) & ((uint64_t{1} << w) - 1); }
    // Where the entries end; the most recent one is at 0.
    int end(int w) const { return (bits_of(listed()) + w - 1) / w * w; }
    bool is_full(Media media) const { return end(width(media)) + width(media) > listed_bits; }

    uint64_t listed() const { return bits_ & (one_untracked - 1); }
    void list(uint64_t entries) { bits_ = (bits_ & ~(one_untracked - 1)) | entries; }

    uint64_t bits_ = 0;  // the list, and above it the number of untracked objects
};

// The crossing of a surface from within `here`.
struct Boundary {
    MediumStack here, beyond;
    float eta = 0;        // relative index; 0: that of the material
    bool absent = false;  // the same medium on both sides, nothing but media, or no place: the surface is ignored
};
// id: medium behind the surface, or none; front: the ray would enter it.
inline Boundary cross(std::span<const Medium> media, const MediumStack& in, uint16_t id, bool front)
{
    Boundary c{in, in};
    if (id == no_medium) return c;
    if (front) {
        c.absent = !c.beyond.enter(media, id);
    } else if (!c.beyond.leave(media, id)) {
        c.absent = c.beyond.leave_untracked();
        if (!c.absent) c.here.enter_first(media, id);
    }
    if (c.absent) return c;
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
