// A row of the stability matrix: a stiff or extreme case with what it is compared to, what is measured and what the
// measure may be. The same rows run as tests (tier A) and as a program that makes a table (stability.cpp).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "geometry/accel.h"

namespace lancer::stability {

// What a full run costs: A some seconds, part of every test run; B minutes; C hours or much memory.
enum class Tier { A, B, C };

enum class Bound { at_most, at_least, exactly };

// One figure. Figures without a bound are told, not judged: what an accelerator loses that promises nothing.
struct Measure {
    std::string what;  // with its unit, if it has one
    double value = 0;
    Bound bound = Bound::at_most;
    double threshold = 0;
    bool judged = true;

    bool passes() const;    // never with NaN, if judged
    double margin() const;  // >= 1 where it passes: threshold over value or the inverse; infinite for 0 of at_most
};

inline Measure at_most(std::string what, double value, double threshold)
{
    return {std::move(what), value, Bound::at_most, threshold};
}
inline Measure at_least(std::string what, double value, double threshold)
{
    return {std::move(what), value, Bound::at_least, threshold};
}
inline Measure exactly(std::string what, double value, double expected)
{
    return {std::move(what), value, Bound::exactly, expected};
}
inline Measure told(std::string what, double value) { return {std::move(what), value, Bound::at_most, 0, false}; }

struct Outcome {
    std::vector<Measure> measures;
    // Of the renders in it, for the cumulative log: samples taken, samples dropped as not finite, rays rejected.
    uint64_t samples = 0, dropped = 0, rejected = 0;
};

// How a row is run.
struct Setup {
    Tier tier = Tier::A;                 // how much of it: rows take more rays, spp and sizes in higher tiers
    std::string accelerator = "embree";  // a name of accelerators (geometry/accel.h), or "embree-fast"

    // The accelerator that is meant, around a scene's geometry.
    std::unique_ptr<Accelerator> make(const Geometry& geometry) const;
    bool fast() const { return accelerator == "embree-fast"; }
    // n in tier A, more in higher ones.
    size_t scaled(size_t a, size_t b, size_t c) const { return tier == Tier::A ? a : tier == Tier::B ? b : c; }
};

struct Row {
    std::string id;         // "P4"
    std::string stiff;      // what is stiff about it, in a few words
    std::string reference;  // what it is compared to: "double", "closed form", "itself at scale 1", "policy"
    Tier tier = Tier::A;    // the lowest tier that runs it
    bool rays = false;      // whether the accelerator matters: such rows are run with each
    std::function<Outcome(const Setup&)> run;
    bool own_threads = false;  // run() calls with_threads itself: it needs more than there are
};

// The groups, each in a file of its own, in the order of their ids.
std::vector<Row> scale_rows();     // N
std::vector<Row> geometry_rows();  // G
std::vector<Row> ray_rows();       // R
std::vector<Row> sphere_rows();    // P: spheres and planes
std::vector<Row> surface_rows();   // D: dielectric, mirror, glossy
std::vector<Row> light_rows();     // L
std::vector<Row> film_rows();      // A: film and sampling
std::vector<Row> camera_rows();    // C: camera and command line
std::vector<Row> material_rows();  // M
std::vector<Row> shipped_rows();   // S: the scenes that come with lancer
std::vector<Row> all_rows();

}  // namespace lancer::stability
