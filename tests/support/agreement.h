// How an accelerator's answers compare with those of a reference in double, counted.
#pragma once

#include "support/hits.h"

namespace lancer {

// The distance in double; of two hits that name the same primitive the same.
double exact_distance(const Geometry& g, const Ray& ray, const Hit& hit);

struct Agreement {
    uint64_t rays = 0;
    uint64_t same = 0;                  // the same primitive, and all bits of the hit
    uint64_t ties = 0;                  // another one, exactly as far
    uint64_t explained = 0;             // another one, no farther from it, from an edge or from an end of the ray than
                                        // float can tell
    uint64_t wrong = 0;                 // all others
    uint64_t first_wrong = UINT64_MAX;  // number of the ray

    void operator+=(const Agreement& a)
    {
        rays += a.rays, same += a.same, ties += a.ties, explained += a.explained, wrong += a.wrong;
        first_wrong = std::min(first_wrong, a.first_wrong);
    }
    // What was found first, against the reference's answer.
    void count(const Geometry& g, const Ray& ray, uint64_t number, const Hit& reference, const Hit& found)
    {
        ++rays;
        if (same_primitive(reference, found)) {
            if (same_bits(reference, found) && reference.exit == found.exit)
                ++same;
            else
                disagree(number);
        } else if (reference && found && exact_distance(g, ray, reference) == exact_distance(g, ray, found)) {
            ++ties;
        } else if (by_rounding(g, ray, reference, found)) {
            ++explained;
        } else {
            disagree(number);
        }
    }
    // Whether anything was found in [t_min, t_max], against the first that the reference finds there; closest: what
    // the accelerator itself says is first.
    void count_any(const Geometry& g, const Ray& ray, uint64_t number, const Hit& reference, bool found,
                   const Hit& closest)
    {
        ++rays;
        const Hit& hit = reference ? reference : closest;
        if (static_cast<bool>(reference) == found)
            ++same;
        else if (hit && by_rounding(g, ray, hit, {}))
            ++explained;
        else
            disagree(number);
    }

private:
    static bool by_rounding(const Geometry& g, const Ray& ray, const Hit& a, const Hit& b)
    {
        if (explainable(g, ray, a, b)) return true;
        // At an end of the interval? One of them then begins or ends it; what is found behind the near end may be
        // anything.
        const Hit& nearer = !b || (a && a.t < b.t) ? a : b;
        const double doubted = doubt(g, ray, nearer);
        if (static_cast<double>(std::abs(nearer.t - ray.t_min)) <= doubted) return true;
        return !(a && b) && static_cast<double>(std::abs(nearer.t - ray.t_max)) <= doubted;
    }
    void disagree(uint64_t number)
    {
        ++wrong;
        first_wrong = std::min(first_wrong, number);
    }
};

}  // namespace lancer
