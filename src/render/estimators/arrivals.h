// What the shadow rays of a pilot brought, and what follows for light sampling.
#pragma once

#include <span>
#include <vector>

#include "integrators/path/light_choice.h"
#include "render/workspace.h"

namespace lancer {

// A vertex of a path, the shadow ray that it sent, if any, and what its BSDF sample found of the sky.
struct Arrival {
    Vec3 p, n;  // place and normal of the surface
    uint32_t slot = 0;
    uint32_t light = Scene::none;  // none: no shadow ray
    float brought = 0;             // luminance; 0 if something was in between
    uint32_t tile = Scene::none;   // of the sky, in which the BSDF sample left the scene
    float found = 0, pdf = 0;      // luminance that it found, and its density
};

// Listens to the paths of a pilot, which do not split: a slot has one vertex at a time.
class ArrivalListener : public NoListener {
public:
    // arrivals: null if nobody wants to know.
    explicit ArrivalListener(std::vector<Arrival>* arrivals) : arrivals_(arrivals) {}

    bool listens() const { return arrivals_ != nullptr; }
    void vertex(const PathState& s, const Surface& surface) const
    {
        if (arrivals_ && !s.last) vertex(s.slot, surface.origin, surface.n);
    }
    void shadow(const ShadowEnds& ends, const Ray&, Color radiance, bool occluded) const
    {
        if (!arrivals_ || ends.from_medium) return;
        Arrival& a = (*arrivals_)[last_[ends.slot]];
        a.light = ends.light;
        if (!occluded) a.brought = luminance(radiance);
    }
    void added(const PathState& s, const Hit& hit, Color radiance) const
    {
        if (arrivals_ && !hit && !s.is_from_medium()) sky(s.slot, s, radiance);
    }
    // The same events for kernels without a Surface at hand; only if it listens. A vertex that paths go on from, and
    // what a ray that left the scene added.
    void vertex(uint32_t slot, Vec3 p, Vec3 n) const
    {
        if (last_.size() <= slot) last_.resize(slot + 1);
        last_[slot] = arrivals_->size();
        arrivals_->push_back({p, n, slot});
    }
    void sky(uint32_t slot, const PathState& s, Color radiance) const
    {
        if (s.specular) return;
        Arrival& a = (*arrivals_)[last_[slot]];
        a.tile = SkyTiles::tile_of(s.ray.dir), a.found = luminance(radiance), a.pdf = s.pdf;
    }

private:
    std::vector<Arrival>* arrivals_;
    mutable std::vector<size_t> last_;  // vertex of each slot
};

// The choice for a pilot: everywhere the same, half by power and half at random, so that each light is tried. Empty
// where lights are not chosen by place: there is one, or there are very many.
LightChoice choice_of_pilot(const LightTable& lights);

// What the samples of a pilot cost in all: their variance relative to the pixel, and their work in shadow rays.
struct PilotCost {
    double variance, work;
};

// Light from outside of the scene, of which tiles may be chosen.
enum class Sky {
    none,
    pictured,
    even,   // of one colour, beside other lights
    alone,  // of one colour, the only light
};

// What the arrivals teach; empty unless it would pay. by: choice of the pilot. What arrivals brought and found is
// relative to the pixel.
LightChoice learn_light_choice(std::span<const Arrival> arrivals, const LightTable& lights, const LightChoice& by,
                               const PilotCost& cost, Sky sky);

}  // namespace lancer
