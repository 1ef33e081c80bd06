#include "harness/agreement.h"

#include "geometry/list/list.h"

namespace lancer::bench {
namespace {

// What the list may cost: triangles times rays, a second or two.
constexpr double most_tests = 1e8;

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

double triangles_of(const Geometry& g)
{
    double count = 1;
    for (const Mesh& m : g.meshes)
        if (!m.instanced) count += static_cast<double>(m.triangles.size());
    for (const Instance& i : g.instances) count += static_cast<double>(g.meshes[i.mesh].triangles.size());
    return count;
}

}  // namespace

Disagreements count_disagreements(const Geometry& geometry, const RaySet& set, const std::vector<Answers>& answers)
{
    const auto differ = [&](const Answers& a, const Answers& b, size_t i) {
        return set.occlusion ? a.occluded[i] != b.occluded[i] : !agrees(a.hits[i], b.hits[i]);
    };
    Disagreements d;
    d.per_million.resize(answers.size());
    std::vector<size_t> disputed;
    for (size_t i = 0; i < set.rays.size(); ++i)
        for (size_t k = 1; k < answers.size(); ++k)
            if (differ(answers[0], answers[k], i)) {
                disputed.push_back(i);
                break;
            }
    const List list(geometry);
    d.disputed = disputed.size();
    d.asked = std::min(disputed.size(), static_cast<size_t>(1 + most_tests / triangles_of(geometry)));
    if (d.asked == 0) return d;
    const double weight =
        1e6 / static_cast<double>(set.rays.size()) * static_cast<double>(d.disputed) / static_cast<double>(d.asked);
    for (size_t n = 0; n < d.asked; ++n) {
        const size_t i = disputed[n * d.disputed / d.asked];
        Answers truth;
        if (set.occlusion)
            truth.occluded.resize(i + 1, list.any(set.rays[i]));
        else
            truth.hits.resize(i + 1, list.closest(set.rays[i]));
        for (size_t k = 0; k < answers.size(); ++k)
            if (differ(answers[k], truth, i)) d.per_million[k] += weight;
    }
    return d;
}

}  // namespace lancer::bench
