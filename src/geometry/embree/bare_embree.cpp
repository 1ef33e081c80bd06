#include "geometry/embree/bare_embree.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <dlfcn.h>

#include <array>
#include <atomic>
#include <fstream>
#include <iterator>

#include "core/clock.h"
#include "core/error.h"

namespace lancer {
namespace {

constexpr size_t chunk = 1024;  // rays of 80 bytes: half of a small second-level cache

// The differences between Embree 3 and 4.
#if RTC_VERSION_MAJOR >= 4
struct BareQuery {
    explicit BareQuery(Coherence coherence)
    {
        rtcInitRayQueryContext(&context);
        rtcInitIntersectArguments(&intersect);
        rtcInitOccludedArguments(&occluded);
        intersect.context = occluded.context = &context;
        intersect.flags = occluded.flags =
            coherence == Coherence::coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    }
    void closest(RTCScene s, RTCRayHit& r) { rtcIntersect1(s, &r, &intersect); }
    void closest(RTCScene s, const int* valid, RTCRayHit8& r) { rtcIntersect8(valid, s, &r, &intersect); }
    void closest(RTCScene s, const int* valid, RTCRayHit16& r) { rtcIntersect16(valid, s, &r, &intersect); }
    void any(RTCScene s, RTCRay& r) { rtcOccluded1(s, &r, &occluded); }
    void any(RTCScene s, const int* valid, RTCRay8& r) { rtcOccluded8(valid, s, &r, &occluded); }
    void any(RTCScene s, const int* valid, RTCRay16& r) { rtcOccluded16(valid, s, &r, &occluded); }

    RTCRayQueryContext context;
    RTCIntersectArguments intersect;
    RTCOccludedArguments occluded;
};
#else
struct BareQuery {
    explicit BareQuery(Coherence coherence)
    {
        rtcInitIntersectContext(&context);
        context.flags = coherence == Coherence::coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                         : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    }
    void closest(RTCScene s, RTCRayHit& r) { rtcIntersect1(s, &context, &r); }
    void closest(RTCScene s, const int* valid, RTCRayHit8& r) { rtcIntersect8(valid, s, &context, &r); }
    void closest(RTCScene s, const int* valid, RTCRayHit16& r) { rtcIntersect16(valid, s, &context, &r); }
    void any(RTCScene s, RTCRay& r) { rtcOccluded1(s, &context, &r); }
    void any(RTCScene s, const int* valid, RTCRay8& r) { rtcOccluded8(valid, s, &context, &r); }
    void any(RTCScene s, const int* valid, RTCRay16& r) { rtcOccluded16(valid, s, &context, &r); }

    RTCIntersectContext context;
};
#endif

void lay_out(RTCRay& r, const Ray& ray)
{
    r.org_x = ray.org.x, r.org_y = ray.org.y, r.org_z = ray.org.z, r.tnear = ray.t_min;
    r.dir_x = ray.dir.x, r.dir_y = ray.dir.y, r.dir_z = ray.dir.z, r.tfar = ray.t_max;
    r.time = 0, r.mask = 0xFFFFFFFFu, r.id = 0, r.flags = 0;
}
void lay_out(RTCRayHit& r, const Ray& ray)
{
    lay_out(r.ray, ray);
    r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
}
// Lane i of a packet.
template <class Packet>
void lay_out(Packet& r, size_t i, const Ray& ray)
{
    r.org_x[i] = ray.org.x, r.org_y[i] = ray.org.y, r.org_z[i] = ray.org.z, r.tnear[i] = ray.t_min;
    r.dir_x[i] = ray.dir.x, r.dir_y[i] = ray.dir.y, r.dir_z[i] = ray.dir.z, r.tfar[i] = ray.t_max;
    r.time[i] = 0, r.mask[i] = 0xFFFFFFFFu, r.id[i] = 0, r.flags[i] = 0;
}

RTCDevice new_device(const std::string& isa)
{
    RTCDevice device = rtcNewDevice(("isa=" + isa).c_str());
    if (!device) throw Error(ErrorKind::failed, {}, "Embree did not start with isa=" + isa);
    return device;
}

ssize_t property_of(const std::string& isa, RTCDeviceProperty property)
{
    RTCDevice device = new_device(isa);
    const ssize_t value = rtcGetDeviceProperty(device, property);
    rtcReleaseDevice(device);
    return value;
}

}  // namespace

std::string name_of(const BareMode& mode)
{
    return std::string("embree-") + (mode.robust ? "robust" : "fast") + (mode.high ? "-high-" : "-medium-") + mode.isa;
}

const char* name_of(Way way) { return way == Way::single ? "single" : way == Way::packet8 ? "packet8" : "packet16"; }

// Embree takes the best that it and the CPU have, whatever it is asked for.
std::string widest_isa()
{
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && has_native_16("avx512")) return "avx512";
    if (__builtin_cpu_supports("avx2")) return "avx2";
    return __builtin_cpu_supports("avx") ? "avx" : "sse4.2";
#else
    return "avx2";  // whatever Embree has of it by the instructions that there are
#endif
}

bool has_native_16(const std::string& isa) { return property_of(isa, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0; }

bool embree_has_asserts()
{
    Dl_info info{};
    if (!dladdr(reinterpret_cast<const void*>(&rtcNewDevice), &info) || !info.dli_fname) return false;
    std::ifstream in(info.dli_fname, std::ios::binary);
    const std::string library{std::istreambuf_iterator<char>(in), {}};
    return library.find("__assert_fail") != std::string::npos;
}

struct BareEmbree::Impl {
    const Geometry& g;
    RTCDevice device;
    RTCScene scene = nullptr;
    std::vector<RTCScene> mesh_scenes{};
    double build_seconds = 0;
    std::atomic<int64_t> bytes{0};

    Impl(const Geometry& geometry, const BareMode& mode) : g(geometry), device(new_device(mode.isa))
    {
        const double start = wall_ns();
        rtcSetDeviceMemoryMonitorFunction(
            device,
            [](void* self, ssize_t more, bool) {
                static_cast<Impl*>(self)->bytes += more;
                return true;
            },
            this);
        scene = new_scene(mode);
        mesh_scenes.resize(g.meshes.size());
        for (uint32_t i = 0; i < g.meshes.size(); ++i) {
            if (g.meshes[i].triangles.empty()) continue;
            if (g.meshes[i].instanced) mesh_scenes[i] = new_scene(mode);
            attach_mesh(g.meshes[i].instanced ? mesh_scenes[i] : scene, i);
            if (mesh_scenes[i]) rtcCommitScene(mesh_scenes[i]);
        }
        for (uint32_t i = 0; i < g.instances.size(); ++i) attach_instance(i);
        rtcCommitScene(scene);
        const RTCError error = rtcGetDeviceError(device);
        if (error != RTC_ERROR_NONE)
            throw Error(ErrorKind::failed, {}, "Embree failed to build the scene, code " + std::to_string(error));
        build_seconds = 1e-9 * (wall_ns() - start);
    }
    ~Impl()
    {
        for (RTCScene s : mesh_scenes)
            if (s) rtcReleaseScene(s);
        if (scene) rtcReleaseScene(scene);
        rtcSetDeviceMemoryMonitorFunction(device, nullptr, nullptr);
        rtcReleaseDevice(device);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    RTCScene new_scene(const BareMode& mode) const
    {
        RTCScene s = rtcNewScene(device);
        rtcSetSceneFlags(s, mode.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
        rtcSetSceneBuildQuality(s, mode.high ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
        return s;
    }
    static void attach(RTCScene to, RTCGeometry geometry, uint32_t id)
    {
        rtcSetGeometryMask(geometry, 0xFFFFFFFFu);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(to, geometry, id);
        rtcReleaseGeometry(geometry);
    }
    void attach_mesh(RTCScene to, uint32_t i) const
    {
        const Mesh& m = g.meshes[i];
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, m.positions.data(), 0,
                                   sizeof(Vec3), m.positions.size() - 1);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, m.triangles.data(), 0,
                                   sizeof m.triangles[0], m.triangles.size());
        attach(to, geometry, i);
    }
    uint32_t first_instance_id() const { return static_cast<uint32_t>(g.meshes.size()); }
    void attach_instance(uint32_t i) const
    {
        const Instance& instance = g.instances[i];
        if (!mesh_scenes[instance.mesh]) return;
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, mesh_scenes[instance.mesh]);
        const Transform& m = instance.to_world;
        std::array<float, 12> columns{};
        size_t k = 0;
        for (const Vec3d& c : {m.x, m.y, m.z, m.translation})
            for (const double x : {c.x, c.y, c.z}) columns[k++] = static_cast<float>(x);
        rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
        attach(scene, geometry, first_instance_id() + i);
    }
    Hit to_hit(uint32_t geometry, uint32_t primitive, uint32_t instance, float t, float u, float v) const
    {
        if (geometry == RTC_INVALID_GEOMETRY_ID) return {};
        const bool placed = instance != RTC_INVALID_GEOMETRY_ID;
        return {
            t, placed ? instance - first_instance_id() : Hit::no_instance, geometry, primitive, {u, v}, Kind::triangle};
    }

    template <class Packet, size_t lanes>
    void closest_packets(std::span<const Ray> rays, std::span<Hit> hits, Coherence coherence) const
    {
        BareQuery query(coherence);
        alignas(64) Packet r;
        alignas(64) std::array<int, lanes> valid;
        for (size_t first = 0; first < rays.size(); first += lanes) {
            const size_t n = std::min(lanes, rays.size() - first);
            for (size_t i = 0; i < lanes; ++i) {
                valid[i] = i < n ? -1 : 0;
                lay_out(r.ray, i, rays[first + std::min(i, n - 1)]);
                r.hit.geomID[i] = r.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
            }
            query.closest(scene, valid.data(), r);
            for (size_t i = 0; i < n; ++i)
                hits[first + i] =
                    to_hit(r.hit.geomID[i], r.hit.primID[i], r.hit.instID[0][i], r.ray.tfar[i], r.hit.u[i], r.hit.v[i]);
        }
    }
    template <class Packet, size_t lanes>
    void any_packets(std::span<const Ray> rays, std::span<uint8_t> occluded, Coherence coherence) const
    {
        BareQuery query(coherence);
        alignas(64) Packet r;
        alignas(64) std::array<int, lanes> valid;
        for (size_t first = 0; first < rays.size(); first += lanes) {
            const size_t n = std::min(lanes, rays.size() - first);
            for (size_t i = 0; i < lanes; ++i) {
                valid[i] = i < n ? -1 : 0;
                lay_out(r, i, rays[first + std::min(i, n - 1)]);
            }
            query.any(scene, valid.data(), r);
            for (size_t i = 0; i < n; ++i) occluded[first + i] = r.tfar[i] < 0;
        }
    }
};

BareEmbree::BareEmbree(const Geometry& geometry, const BareMode& mode) : impl_(std::make_unique<Impl>(geometry, mode))
{
}
BareEmbree::~BareEmbree() = default;

double BareEmbree::build_seconds() const { return impl_->build_seconds; }
uint64_t BareEmbree::bytes() const { return static_cast<uint64_t>(std::max<int64_t>(0, impl_->bytes)); }

Hit BareEmbree::closest(const Ray& ray) const
{
    BareQuery query(Coherence::incoherent);
    RTCRayHit r;
    lay_out(r, ray);
    query.closest(impl_->scene, r);
    return impl_->to_hit(r.hit.geomID, r.hit.primID, r.hit.instID[0], r.ray.tfar, r.hit.u, r.hit.v);
}

bool BareEmbree::any(const Ray& ray) const
{
    BareQuery query(Coherence::incoherent);
    RTCRay r;
    lay_out(r, ray);
    query.any(impl_->scene, r);
    return r.tfar < 0;
}

void BareEmbree::closest(std::span<const Ray> rays, std::span<Hit> hits, Way way, Coherence coherence) const
{
    if (way == Way::packet8) return impl_->closest_packets<RTCRayHit8, 8>(rays, hits, coherence);
    if (way == Way::packet16) return impl_->closest_packets<RTCRayHit16, 16>(rays, hits, coherence);
    for (size_t i = 0; i < rays.size(); ++i) hits[i] = closest(rays[i]);
}

void BareEmbree::any(std::span<const Ray> rays, std::span<uint8_t> occluded, Way way, Coherence coherence) const
{
    if (way == Way::packet8) return impl_->any_packets<RTCRay8, 8>(rays, occluded, coherence);
    if (way == Way::packet16) return impl_->any_packets<RTCRay16, 16>(rays, occluded, coherence);
    for (size_t i = 0; i < rays.size(); ++i) occluded[i] = any(rays[i]);
}

double BareEmbree::replay_closest_ns(std::span<const Ray> rays, Coherence coherence) const
{
    BareQuery query(coherence);
    std::vector<RTCRayHit> laid_out(std::min(chunk, rays.size()));
    double ns = 0;
    for (size_t first = 0; first < rays.size(); first += chunk) {
        const size_t n = std::min(chunk, rays.size() - first);
        for (size_t i = 0; i < n; ++i) lay_out(laid_out[i], rays[first + i]);
        const double start = thread_ns();
        for (size_t i = 0; i < n; ++i) query.closest(impl_->scene, laid_out[i]);
        ns += thread_ns() - start;
    }
    return ns;
}

double BareEmbree::replay_any_ns(std::span<const Ray> rays) const
{
    BareQuery query(Coherence::incoherent);
    std::vector<RTCRay> laid_out(std::min(chunk, rays.size()));
    double ns = 0;
    for (size_t first = 0; first < rays.size(); first += chunk) {
        const size_t n = std::min(chunk, rays.size() - first);
        for (size_t i = 0; i < n; ++i) lay_out(laid_out[i], rays[first + i]);
        const double start = thread_ns();
        for (size_t i = 0; i < n; ++i) query.any(impl_->scene, laid_out[i]);
        ns += thread_ns() - start;
    }
    return ns;
}

}  // namespace lancer
