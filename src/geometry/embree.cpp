#include "geometry/embree.h"

#include <array>
#include <atomic>
#include <chrono>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "core/error.h"

static_assert(RTC_VERSION >= 31300, "Embree 3.13 or newer is required");

namespace lancer {
namespace {

#ifdef LANCER_STD_THREADS
constexpr const char* build_threads =
    ",threads=1";  // ThreadSanitizer cannot see how TBB hands over our callbacks' data
#else
constexpr const char* build_threads = "";
#endif

constexpr uint32_t packet = 8;  // lanes of one call; 16 are native only with AVX-512

// The differences between Embree 3 and 4, all of them: how a query is told its flags and context.
class Query {
public:
    explicit Query(Coherence coherence)
    {
#if RTC_VERSION_MAJOR >= 4
        const auto flags =
            coherence == Coherence::coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
        rtcInitIntersectArguments(&intersect_);
        rtcInitOccludedArguments(&occluded_);
        intersect_.flags = occluded_.flags = flags;
#else
        rtcInitIntersectContext(&context_);
        context_.flags = coherence == Coherence::coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                          : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
#endif
    }
#if RTC_VERSION_MAJOR >= 4
    void intersect(RTCScene s, RTCRayHit& r) { rtcIntersect1(s, &r, &intersect_); }
    void intersect(const int* valid, RTCScene s, RTCRayHit8& r) { rtcIntersect8(valid, s, &r, &intersect_); }
    void occluded(RTCScene s, RTCRay& r) { rtcOccluded1(s, &r, &occluded_); }
    void occluded(const int* valid, RTCScene s, RTCRay8& r) { rtcOccluded8(valid, s, &r, &occluded_); }

private:
    RTCIntersectArguments intersect_;
    RTCOccludedArguments occluded_;
#else
    void intersect(RTCScene s, RTCRayHit& r) { rtcIntersect1(s, &context_, &r); }
    void intersect(const int* valid, RTCScene s, RTCRayHit8& r) { rtcIntersect8(valid, s, &context_, &r); }
    void occluded(RTCScene s, RTCRay& r) { rtcOccluded1(s, &context_, &r); }
    void occluded(const int* valid, RTCScene s, RTCRay8& r) { rtcOccluded8(valid, s, &context_, &r); }

private:
    RTCIntersectContext context_;
#endif
};

// A box in float that holds one in double.
RTCBounds outwards(const Bounds& b)
{
    const auto down = [](double x) {
        return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity());
    };
    const auto up = [](double x) {
        return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity());
    };
    return {down(b.lower.x), down(b.lower.y), down(b.lower.z), 0, up(b.upper.x), up(b.upper.y), up(b.upper.z), 0};
}

Ray lane_ray(RTCRayN* r, unsigned n, unsigned i)
{
    return {{RTCRayN_org_x(r, n, i), RTCRayN_org_y(r, n, i), RTCRayN_org_z(r, n, i)},
            RTCRayN_tnear(r, n, i),
            {RTCRayN_dir_x(r, n, i), RTCRayN_dir_y(r, n, i), RTCRayN_dir_z(r, n, i)},
            RTCRayN_tfar(r, n, i)};
}

// The callbacks of one kind of shape, all through intersect() and bounds() of shapes.h.
template <class Shape>
void bounds_callback(const RTCBoundsFunctionArguments* a)
{
    *a->bounds_o = outwards(bounds(static_cast<const Shape*>(a->geometryUserPtr)[a->primID]));
}
template <class Shape>
void intersect_callback(const RTCIntersectFunctionNArguments* a)
{
    const Shape& shape = static_cast<const Shape*>(a->geometryUserPtr)[a->primID];
    RTCRayN* rays = RTCRayHitN_RayN(a->rayhit, a->N);
    RTCHitN* hits = RTCRayHitN_HitN(a->rayhit, a->N);
    for (unsigned i = 0; i < a->N; ++i) {
        if (a->valid[i] != -1) continue;
        const auto t = lancer::intersect(shape, lane_ray(rays, a->N, i));
#if RTC_VERSION_MAJOR >= 4
        a->valid[i] = t ? -1 : 0;
#endif
        if (!t) continue;
        // Ties go to the lowest (instance, geometry, primitive), in whatever order Embree comes by.
        const unsigned geometry = RTCHitN_geomID(hits, a->N, i);
        if (geometry != RTC_INVALID_GEOMETRY_ID && static_cast<float>(*t) == RTCRayN_tfar(rays, a->N, i) &&
            (RTCHitN_instID(hits, a->N, i, 0) != RTC_INVALID_GEOMETRY_ID || geometry < a->geomID ||
             (geometry == a->geomID && RTCHitN_primID(hits, a->N, i) < a->primID))) {
#if RTC_VERSION_MAJOR >= 4
            a->valid[i] = 0;
#endif
            continue;
        }
        RTCRayN_tfar(rays, a->N, i) = static_cast<float>(*t);
        RTCHitN_geomID(hits, a->N, i) = a->geomID;
        RTCHitN_primID(hits, a->N, i) = a->primID;
        RTCHitN_instID(hits, a->N, i, 0) = a->context->instID[0];
    }
}
template <class Shape>
void occluded_callback(const RTCOccludedFunctionNArguments* a)
{
    const Shape& shape = static_cast<const Shape*>(a->geometryUserPtr)[a->primID];
    for (unsigned i = 0; i < a->N; ++i) {
        if (a->valid[i] != -1) continue;
        const bool hit = lancer::intersect(shape, lane_ray(a->ray, a->N, i)).has_value();
#if RTC_VERSION_MAJOR >= 4
        a->valid[i] = hit ? -1 : 0;
#endif
        if (hit) RTCRayN_tfar(a->ray, a->N, i) = -std::numeric_limits<float>::infinity();
    }
}

class Embree final : public Accelerator {
public:
    Embree(const Geometry& geometry, const std::string& isa) : g_(geometry)
    {
        const auto start = std::chrono::steady_clock::now();
        device_ = rtcNewDevice(("isa=" + isa + build_threads).c_str());
        if (!device_)
            throw Error(ErrorKind::failed, {},
                        "Embree did not start (isa=" + isa + "): is this instruction set supported by the CPU?");
        rtcSetDeviceMemoryMonitorFunction(
            device_,
            [](void* self, ssize_t bytes, bool) {
                static_cast<Embree*>(self)->bytes_ += bytes;
                return true;
            },
            this);
        scene_ = new_scene();
        const auto meshes = static_cast<uint32_t>(g_.meshes.size());
        mesh_scenes_.resize(meshes);
        for (uint32_t i = 0; i < meshes; ++i) {
            if (g_.meshes[i].triangles.empty()) continue;
            if (!g_.meshes[i].instanced) {
                attach_mesh(scene_, i);
                continue;
            }
            mesh_scenes_[i] = new_scene();
            attach_mesh(mesh_scenes_[i], i);
            rtcCommitScene(mesh_scenes_[i]);
        }
        // An empty kind is not attached: Embree then has nothing to traverse for it.
        sphere_id_ = meshes;
        plane_id_ = meshes + 1;
        first_instance_id_ = meshes + 2;
        attach_shapes(g_.spheres, sphere_id_);
        attach_shapes(g_.planes, plane_id_);
        for (uint32_t i = 0; i < g_.instances.size(); ++i) attach_instance(i);
        rtcCommitScene(scene_);
        if (const RTCError e = rtcGetDeviceError(device_); e != RTC_ERROR_NONE) {
            release();
            throw Error(ErrorKind::failed, {},
                        e == RTC_ERROR_OUT_OF_MEMORY ? "out of memory while building the Embree scene"
                                                     : "Embree failed to build the scene, code " + std::to_string(e));
        }
        build_seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    ~Embree() override { release(); }
    Embree(const Embree&) = delete;
    Embree& operator=(const Embree&) = delete;

    Hit closest(const Ray& ray) const override
    {
        if (!is_traceable(ray)) return {};
        RTCRayHit r;
        fill(r.ray, ray);
        r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        Query(Coherence::incoherent).intersect(scene_, r);
        return to_hit(ray, r.hit.geomID, r.hit.primID, r.hit.instID[0], r.ray.tfar);
    }
    bool any(const Ray& ray) const override
    {
        if (!is_traceable(ray)) return false;
        RTCRay r;
        fill(r, ray);
        Query(Coherence::incoherent).occluded(scene_, r);
        return r.tfar < 0;
    }
    void closest(std::span<const Ray> rays, std::span<Hit> hits, Coherence coherence) const override
    {
        Query query(coherence);
        RTCRayHit8 r;
        alignas(32) std::array<int, packet> valid;
        for (size_t first = 0; first < rays.size(); first += packet) {
            const size_t n = std::min<size_t>(packet, rays.size() - first);
            fill_packet(r.ray, valid, rays.subspan(first, n));
            for (uint32_t i = 0; i < packet; ++i) r.hit.geomID[i] = r.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
            query.intersect(valid.data(), scene_, r);
            for (size_t i = 0; i < n; ++i)
                hits[first + i] =
                    to_hit(rays[first + i], r.hit.geomID[i], r.hit.primID[i], r.hit.instID[0][i], r.ray.tfar[i]);
        }
    }
    void any(std::span<const Ray> rays, std::span<uint8_t> occluded) const override
    {
        Query query(Coherence::incoherent);
        RTCRay8 r;
        alignas(32) std::array<int, packet> valid;
        for (size_t first = 0; first < rays.size(); first += packet) {
            const size_t n = std::min<size_t>(packet, rays.size() - first);
            fill_packet(r, valid, rays.subspan(first, n));
            query.occluded(valid.data(), scene_, r);
            for (size_t i = 0; i < n; ++i) occluded[first + i] = valid[i] && r.tfar[i] < 0;
        }
    }
    AccelStats stats() const override { return {build_seconds_, static_cast<uint64_t>(std::max<int64_t>(0, bytes_))}; }

private:
    RTCScene new_scene() const
    {
        RTCScene s = rtcNewScene(device_);
        rtcSetSceneFlags(s, RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(s, RTC_BUILD_QUALITY_HIGH);
        return s;
    }
    RTCGeometry new_geometry(RTCGeometryType type) const
    {
        RTCGeometry g = rtcNewGeometry(device_, type);
        rtcSetGeometryMask(g, 0xFFFFFFFFu);  // the default is 1 in Embree 4
        return g;
    }
    static void attach(RTCScene scene, RTCGeometry g, uint32_t id)
    {
        rtcCommitGeometry(g);
        rtcAttachGeometryByID(scene, g, id);
        rtcReleaseGeometry(g);
    }
    void attach_mesh(RTCScene scene, uint32_t index) const
    {
        const Mesh& m = g_.meshes[index];
        RTCGeometry g = new_geometry(RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, m.positions.data(), 0, sizeof(Vec3),
                                   m.positions.size() - 1);
        rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, m.triangles.data(), 0,
                                   sizeof m.triangles[0], m.triangles.size());
        attach(scene, g, index);
    }
    template <class Shape>
    void attach_shapes(const std::vector<Shape>& shapes, uint32_t id) const
    {
        if (shapes.empty()) return;
        RTCGeometry g = new_geometry(RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(g, static_cast<unsigned>(shapes.size()));
        rtcSetGeometryUserData(g, const_cast<Shape*>(shapes.data()));
        rtcSetGeometryBoundsFunction(g, bounds_callback<Shape>, nullptr);
        rtcSetGeometryIntersectFunction(g, intersect_callback<Shape>);
        rtcSetGeometryOccludedFunction(g, occluded_callback<Shape>);
        attach(scene_, g, id);
    }
    void attach_instance(uint32_t i) const
    {
        const Instance& instance = g_.instances[i];
        if (!mesh_scenes_[instance.mesh]) return;
        RTCGeometry g = new_geometry(RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(g, mesh_scenes_[instance.mesh]);
        const Transform& m = instance.to_world;
        std::array<float, 12> columns{};
        size_t k = 0;
        for (const Vec3d& c : {m.x, m.y, m.z, m.translation})
            for (const double x : {c.x, c.y, c.z}) columns[k++] = static_cast<float>(x);
        rtcSetGeometryTransform(g, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
        attach(scene_, g, first_instance_id_ + i);
    }
    void release()
    {
        for (RTCScene s : mesh_scenes_)
            if (s) rtcReleaseScene(s);
        if (scene_) rtcReleaseScene(scene_);
        if (device_) {
            rtcSetDeviceMemoryMonitorFunction(device_, nullptr, nullptr);
            rtcReleaseDevice(device_);
        }
    }

    static void fill(RTCRay& r, const Ray& ray)
    {
        r.org_x = ray.org.x, r.org_y = ray.org.y, r.org_z = ray.org.z, r.tnear = ray.t_min;
        r.dir_x = ray.dir.x, r.dir_y = ray.dir.y, r.dir_z = ray.dir.z, r.tfar = ray.t_max;
        r.time = 0, r.mask = 0xFFFFFFFFu, r.id = 0, r.flags = 0;
    }
    // Debian's Embree has its assertions on: one NaN lane would end the process, so such lanes are masked out.
    static void fill_packet(RTCRay8& r, std::array<int, packet>& valid, std::span<const Ray> rays)
    {
        constexpr Ray idle{{0, 0, 0}, 0, {0, 0, 1}, 0};
        for (size_t i = 0; i < packet; ++i) {
            const bool ok = i < rays.size() && is_traceable(rays[i]);
            const Ray& ray = ok ? rays[i] : idle;
            valid[i] = ok ? -1 : 0;
            r.org_x[i] = ray.org.x, r.org_y[i] = ray.org.y, r.org_z[i] = ray.org.z, r.tnear[i] = ray.t_min;
            r.dir_x[i] = ray.dir.x, r.dir_y[i] = ray.dir.y, r.dir_z[i] = ray.dir.z, r.tfar[i] = ray.t_max;
            r.time[i] = 0, r.mask[i] = 0xFFFFFFFFu, r.id[i] = 0, r.flags[i] = 0;
        }
    }
    Hit to_hit(const Ray& ray, uint32_t geometry, uint32_t primitive, uint32_t instance, float t) const
    {
        if (geometry == RTC_INVALID_GEOMETRY_ID) return {};
        if (geometry == sphere_id_) return {t, Hit::no_instance, 0, primitive, {}, Kind::sphere};
        if (geometry == plane_id_) return {t, Hit::no_instance, 0, primitive, {}, Kind::plane};
        const uint32_t i = instance == RTC_INVALID_GEOMETRY_ID ? Hit::no_instance : instance - first_instance_id_;
        return refine(g_, ray, {t, i, geometry, primitive, {}, Kind::triangle});
    }

    const Geometry& g_;
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
    std::vector<RTCScene> mesh_scenes_;
    uint32_t sphere_id_ = 0, plane_id_ = 0, first_instance_id_ = 0;
    double build_seconds_ = 0;
    std::atomic<int64_t> bytes_{0};
};

}  // namespace

std::unique_ptr<Accelerator> make_embree(const Geometry& geometry, const std::string& isa)
{
    return std::make_unique<Embree>(geometry, isa);
}

std::string embree_version()
{
    RTCDevice d = rtcNewDevice(nullptr);
    const auto v = rtcGetDeviceProperty(d, RTC_DEVICE_PROPERTY_VERSION);
    rtcReleaseDevice(d);
    return std::to_string(v / 10000) + "." + std::to_string(v / 100 % 100) + "." + std::to_string(v % 100);
}

}  // namespace lancer
