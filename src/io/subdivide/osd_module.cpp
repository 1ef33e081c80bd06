// The module lancer_subdivide: refines meshes by OpenSubdiv. Catmull, Clark, "Recursively Generated B-Spline Surfaces
// on Arbitrary Topological Meshes", Computer-Aided Design 10(6), 1978.
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <array>
#include <cstdio>
#include <exception>
#include <memory>
#include <vector>

#include "io/subdivide/module.h"

namespace far = OpenSubdiv::Far;
namespace sdc = OpenSubdiv::Sdc;

namespace {

// What a refiner interpolates.
template <class T, size_t n>
struct Numbers {
    std::array<T, n> v{};
    void Clear() { v.fill(0); }
    void AddWithWeight(const Numbers& other, T weight)
    {
        for (size_t i = 0; i < n; ++i) v[i] += weight * other.v[i];
    }
};
using Place = Numbers<double, 3>;
using Values = Numbers<float, lancer_subdivide_vertex_numbers>;
using Uvs = Numbers<float, lancer_subdivide_uv_numbers>;

template <class T, size_t n>
std::vector<Numbers<T, n>> list_of(const T* numbers, uint32_t count)
{
    std::vector<Numbers<T, n>> list(count);
    for (uint32_t i = 0; i < count; ++i)
        for (size_t k = 0; k < n; ++k) list[i].v[k] = numbers[size_t{i} * n + k];
    return list;
}
template <class T, size_t n>
void copy(const std::vector<Numbers<T, n>>& list, T* numbers)
{
    for (const Numbers<T, n>& x : list)
        for (const T v : x.v) *numbers++ = v;
}

}  // namespace

struct LancerSubdivided {
    std::vector<Place> places;
    std::vector<Values> values;
    std::vector<Uvs> uvs;
    std::unique_ptr<far::TopologyRefiner> refiner;

    const far::TopologyLevel& last() const { return refiner->GetLevel(refiner->GetMaxLevel()); }
};

namespace {

std::unique_ptr<far::TopologyRefiner> refiner_of(const LancerCage& cage)
{
    far::TopologyDescriptor topology;
    topology.numVertices = static_cast<int>(cage.vertices);
    topology.numFaces = static_cast<int>(cage.faces);
    topology.numVertsPerFace = cage.face_sizes;
    topology.vertIndicesPerFace = cage.corners;
    far::TopologyDescriptor::FVarChannel uvs;
    uvs.numValues = static_cast<int>(cage.uvs);
    uvs.valueIndices = cage.uv_corners;
    if (cage.uvs > 0) topology.numFVarChannels = 1, topology.fvarChannels = &uvs;
    sdc::Options options;
    options.SetVtxBoundaryInterpolation(sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
    options.SetFVarLinearInterpolation(sdc::Options::FVAR_LINEAR_BOUNDARIES);
    using Factory = far::TopologyRefinerFactory<far::TopologyDescriptor>;
    return std::unique_ptr<far::TopologyRefiner>(
        Factory::Create(topology, Factory::Options(sdc::SCHEME_CATMARK, options)));
}

void refine(const LancerCage& cage, LancerSubdivided& made)
{
    made.places = list_of<double, 3>(cage.positions, cage.vertices);
    made.values = list_of<float, lancer_subdivide_vertex_numbers>(cage.vertex_values, cage.vertices);
    if (cage.uvs > 0) made.uvs = list_of<float, lancer_subdivide_uv_numbers>(cage.uv_values, cage.uvs);
    made.refiner->RefineUniform(far::TopologyRefiner::UniformOptions(static_cast<int>(cage.levels)));
    const far::PrimvarRefinerReal<double> in_double(*made.refiner);
    const far::PrimvarRefinerReal<float> in_float(*made.refiner);
    for (int level = 1; level <= static_cast<int>(cage.levels); ++level) {
        const far::TopologyLevel& there = made.refiner->GetLevel(level);
        std::vector<Place> places(static_cast<size_t>(there.GetNumVertices()));
        in_double.Interpolate(level, made.places, places);
        made.places = std::move(places);
        std::vector<Values> values(static_cast<size_t>(there.GetNumVertices()));
        in_float.Interpolate(level, made.values, values);
        made.values = std::move(values);
        if (cage.uvs == 0) continue;
        std::vector<Uvs> uvs(static_cast<size_t>(there.GetNumFVarValues(0)));
        in_float.InterpolateFaceVarying(level, made.uvs, uvs, 0);
        made.uvs = std::move(uvs);
    }
}

}  // namespace

extern "C" {

int32_t lancer_subdivide_version() { return lancer_subdivide_current_version; }

LancerSubdivided* lancer_subdivide_refine(const LancerCage* cage, LancerSubdividedInfo* info)
{
    const auto fail = [&](const char* message) -> LancerSubdivided* {
        std::snprintf(info->message, sizeof info->message, "%s", message);
        return nullptr;
    };
    try {
        auto made = std::make_unique<LancerSubdivided>();
        made->refiner = refiner_of(*cage);
        if (!made->refiner) return fail("its faces do not make a surface that OpenSubdiv accepts");
        refine(*cage, *made);
        info->vertices = static_cast<uint32_t>(made->places.size());
        info->faces = static_cast<uint32_t>(made->last().GetNumFaces());
        info->uvs = static_cast<uint32_t>(made->uvs.size());
        return made.release();
    } catch (const std::exception& e) {
        return fail(e.what());
    }
}

void lancer_subdivide_copy(const LancerSubdivided* made, double* positions, float* vertex_values, float* uv_values,
                           uint32_t* corners, uint32_t* uv_corners, uint32_t* parents)
{
    copy(made->places, positions);
    copy(made->values, vertex_values);
    if (uv_values) copy(made->uvs, uv_values);
    const far::TopologyLevel& last = made->last();
    for (int face = 0; face < last.GetNumFaces(); ++face) {
        for (const int corner : {0, 1, 2, 3}) *corners++ = static_cast<uint32_t>(last.GetFaceVertices(face)[corner]);
        if (uv_corners)
            for (const int corner : {0, 1, 2, 3})
                *uv_corners++ = static_cast<uint32_t>(last.GetFaceFVarValues(face, 0)[corner]);
        int parent = face;
        for (int level = made->refiner->GetMaxLevel(); level > 0; --level)
            parent = made->refiner->GetLevel(level).GetFaceParentFace(parent);
        *parents++ = static_cast<uint32_t>(parent);
    }
}

void lancer_subdivide_close(LancerSubdivided* made) { delete made; }
}
