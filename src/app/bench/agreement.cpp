#include "app/bench/agreement.h"

#include "app/bench/batches.h"
#include "core/parallel.h"
#include "geometry/list/list.h"

namespace lancer {
namespace {

bool same_primitive(const Hit& a, const Hit& b)
{
    if (!a || !b) return !a && !b;
    return a.kind == b.kind && a.instance == b.instance && a.geometry == b.geometry && a.primitive == b.primitive;
}

// Equally far ones are as good: which of them is found first is the accelerator's choice.
bool agrees(const Hit& said, const Hit& truth)
{
    return same_primitive(said, truth) || (said && truth && said.t == truth.t);
}

}  // namespace

RayMethod direct_method(std::string name, const BareEmbree& embree, Way way)
{
    const BareEmbree* e = &embree;
    return {std::move(name), name_of(way), [=](auto rays, auto hits, Coherence c) { e->closest(rays, hits, way, c); },
            [=](auto rays, auto out, Coherence c) { e->any(rays, out, way, c); }, false};
}

RayMethod single_method(std::string name, const Accelerator& accel)
{
    const Accelerator* a = &accel;
    return {std::move(name), "single",
            [=](auto rays, auto hits, Coherence) {
                for (size_t i = 0; i < rays.size(); ++i) hits[i] = a->closest(rays[i]);
            },
            [=](auto rays, auto out, Coherence) {
                for (size_t i = 0; i < rays.size(); ++i) out[i] = a->any(rays[i]);
            }};
}

RayMethod batch_method(std::string name, const Accelerator& accel)
{
    const Accelerator* a = &accel;
    return {std::move(name), "batch",
            [=](auto rays, auto hits, Coherence c) {
                in_batches(rays, hits, [&](auto some, auto found) { a->closest(some, found, c); });
            },
            [=](auto rays, auto out, Coherence) {
                in_batches(rays, out, [&](auto some, auto found) { a->any(some, found); });
            }};
}

Answers answer(const RayMethod& method, const RaySet& set, const Geometry& g)
{
    Answers a;
    if (set.occlusion) {
        a.occluded.resize(set.rays.size());
        method.any(set.rays, a.occluded, set.coherence);
        return a;
    }
    a.hits.resize(set.rays.size());
    method.closest(set.rays, a.hits, set.coherence);
    if (!method.refined)
        for (size_t i = 0; i < set.rays.size(); ++i)
            if (a.hits[i]) a.hits[i] = refine(g, set.rays[i], a.hits[i]);
    return a;
}

uint64_t drawn_triangles(const Geometry& g)
{
    uint64_t count = 0;
    for (const Mesh& m : g.meshes)
        if (!m.instanced) count += m.triangles.size();
    for (const Instance& i : g.instances) count += g.meshes[i.mesh].triangles.size();
    return count;
}

Disagreements count_disagreements(const Geometry& geometry, const RaySet& set, const std::vector<Answers>& answers,
                                  double most_tests)
{
    const auto differ = [&](const Answers& a, const Answers& b, size_t i) {
        return set.occlusion ? a.occluded[i] != b.occluded[i] : !agrees(a.hits[i], b.hits[i]);
    };
    const auto is_hit = [&](const Answers& a, size_t i) {
        return set.occlusion ? a.occluded[i] != 0 : bool(a.hits[i]);
    };
    Disagreements d;
    d.per_million.resize(answers.size());
    d.missed_per_million.resize(answers.size());
    std::vector<size_t> disputed;
    for (size_t i = 0; i < set.rays.size(); ++i)
        for (size_t k = 1; k < answers.size(); ++k)
            if (differ(answers[0], answers[k], i)) {
                disputed.push_back(i);
                break;
            }
    const List list(geometry);
    d.disputed = disputed.size();
    d.asked = std::min(disputed.size(),
                       static_cast<size_t>(1 + most_tests / static_cast<double>(1 + drawn_triangles(geometry))));
    if (d.asked == 0) return d;
    const double weight =
        1e6 / static_cast<double>(set.rays.size()) * static_cast<double>(d.disputed) / static_cast<double>(d.asked);
    Answers truth;
    set.occlusion ? truth.occluded.resize(set.rays.size()) : truth.hits.resize(set.rays.size());
    const auto ray_of = [&](size_t n) { return disputed[n * d.disputed / d.asked]; };
    parallel_for(d.asked, [&](size_t n) {
        const size_t i = ray_of(n);
        if (set.occlusion)
            truth.occluded[i] = list.any(set.rays[i]);
        else
            truth.hits[i] = list.closest(set.rays[i]);
    });
    for (size_t n = 0; n < d.asked; ++n)
        for (size_t k = 0; k < answers.size(); ++k) {
            const size_t i = ray_of(n);
            if (!differ(answers[k], truth, i)) continue;
            d.per_million[k] += weight;
            if (is_hit(truth, i) && !is_hit(answers[k], i)) d.missed_per_million[k] += weight;
        }
    return d;
}

}  // namespace lancer
