// What the shadow rays of a pilot brought, and what follows for light sampling.
#pragma once

#include <span>
#include <vector>

#include "integrators/path/light_choice.h"
#include "render/workspace.h"

namespace lancer {

// A vertex of a path, and the shadow ray that it sent, if any.
struct Arrival {
    Vec3 p, n;  // place and normal of the surface
    uint32_t slot = 0;
    uint32_t light = Scene::none;  // none: no shadow ray
    float brought = 0;             // luminance; 0 if something was in between
};

// Listens to the paths of a pilot, which do not split: a slot has one vertex at a time.
class ArrivalListener : public NoListener {
public:
    // arrivals: null if nobody wants to know.
    explicit ArrivalListener(std::vector<Arrival>* arrivals) : arrivals_(arrivals) {}

    void vertex(const PathState& s, const Surface& surface) const
    {
        if (!arrivals_) return;
        if (last_.size() <= s.slot) last_.resize(s.slot + 1);
        last_[s.slot] = arrivals_->size();
        arrivals_->push_back({surface.origin, surface.n, s.slot});
    }
    void shadow(uint32_t slot, uint32_t light, const Ray&, Color radiance, bool occluded) const
    {
        if (!arrivals_) return;
        Arrival& a = (*arrivals_)[last_[slot]];
        a.light = light;
        if (!occluded) a.brought = luminance(radiance);
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

// What the arrivals teach; empty unless it would pay. by: choice of the pilot. brought: relative to the pixel.
LightChoice learn_light_choice(std::span<const Arrival> arrivals, const LightTable& lights, const LightChoice& by,
                               const PilotCost& cost);

}  // namespace lancer
