#include "geometry/embree/embree.h"

#include <array>
#include <atomic>
#include <chrono>

#include "core/error.h"
#include "geometry/embree/callbacks.h"
#include "geometry/embree/large_shapes.h"
#include "geometry/object_boxes.h"
#include "geometry/refine_all.h"

namespace lancer {
namespace {

#ifdef LANCER_STD_THREADS
constexpr const char* build_threads =
    ",threads=1";  // ThreadSanitizer cannot see how TBB hands over our callbacks' data
#else
constexpr const char* build_threads = "";
#endif

using namespace embree;

float extent_of(const FloatBox& b)
{
    float extent = 0;
    for (const Vec3 p : {b.lower, b.upper})
        for (const float x : {p.x, p.y, p.z})
            if (std::isfinite(x)) extent = std::max(extent, std::abs(x));
    return extent;
}
float extent_of_meshes(const Geometry& g)
{
    std::vector<FloatBox> boxes(g.meshes.size());
    for (size_t i = 0; i < boxes.size(); ++i)
        for (const Vec3& p : g.meshes[i].positions) boxes[i].grow({p, p});
    float extent = 0;
    for (size_t i = 0; i < boxes.size(); ++i)
        if (!g.meshes[i].instanced) extent = std::max(extent, extent_of(boxes[i]));
    for (const Instance& i : g.instances)
        if (!boxes[i.mesh].empty()) extent = std::max(extent, extent_of(box_of(boxes[i.mesh], i.to_world)));
    return extent;
}

class Embree final : public Accelerator {
public:
    Embree(const Geometry& geometry, const std::string& isa, EmbreeMode mode)
        : g_(geometry), mode_(mode), data_{g_, choose_large_shapes(g_), extent_of_meshes(g_)}
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
        attach_shapes<Kind::sphere>(sphere_id(g_));
        attach_shapes<Kind::plane>(plane_id(g_));
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
        Hit hit;
        closest({&ray, 1}, {&hit, 1}, Coherence::incoherent);
        return hit;
    }
    bool any(const Ray& ray) const override
    {
        uint8_t occluded = 0;
        any({&ray, 1}, {&occluded, 1});
        return occluded != 0;
    }
    void closest(std::span<const Ray> rays, std::span<Hit> hits, Coherence coherence) const override
    {
        Query query(coherence);
        RTCRayHit8 r;
        for (size_t first = 0; first < rays.size(); first += packet) {
            const size_t n = std::min<size_t>(packet, rays.size() - first);
            query.load(rays.subspan(first, n), data_.extent, r);
            if (!data_.wide.empty()) closest_large_shape(g_, data_.wide, query, r);
            if (attached_) query.closest(scene_, r);
            for (size_t i = 0; i < n; ++i) hits[first + i] = query.nearest(i);
        }
        refine_all(g_, rays, hits);
    }
    void any(std::span<const Ray> rays, std::span<uint8_t> occluded) const override
    {
        Query query(Coherence::incoherent);
        RTCRay8 r;
        for (size_t first = 0; first < rays.size(); first += packet) {
            const size_t n = std::min<size_t>(packet, rays.size() - first);
            query.load(rays.subspan(first, n), r);
            uint32_t met = data_.wide.empty() ? 0 : any_large_shape(g_, data_.wide, r);
            if (attached_) met = query.any(scene_, r, met);
            for (size_t i = 0; i < n; ++i) occluded[first + i] = met >> i & 1;
        }
    }
    AccelStats stats() const override { return {build_seconds_, static_cast<uint64_t>(std::max<int64_t>(0, bytes_))}; }

private:
    RTCScene new_scene() const
    {
        RTCScene s = rtcNewScene(device_);
        rtcSetSceneFlags(s, mode_ == EmbreeMode::robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
        rtcSetSceneBuildQuality(s, RTC_BUILD_QUALITY_HIGH);
        return s;
    }
    RTCGeometry new_geometry(RTCGeometryType type) const
    {
        RTCGeometry g = rtcNewGeometry(device_, type);
        rtcSetGeometryMask(g, 0xFFFFFFFFu);  // the default is 1 in Embree 4
        return g;
    }
    void attach(RTCScene scene, RTCGeometry g, uint32_t id)
    {
        attached_ = true;
        rtcCommitGeometry(g);
        rtcAttachGeometryByID(scene, g, id);
        rtcReleaseGeometry(g);
    }
    void attach_mesh(RTCScene scene, uint32_t index)
    {
        const Mesh& m = g_.meshes[index];
        RTCGeometry g = new_geometry(RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, m.positions.data(), 0, sizeof(Vec3),
                                   m.vertices() * m.rows);
        rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, m.triangles.data(), 0,
                                   sizeof m.triangles[0], m.triangles.size());
        rtcSetGeometryUserData(g, &data_);
        rtcSetGeometryIntersectFilterFunction(g, nearest_callback);
        if (g_.alpha_test.passes_through && !g_.alpha_test.meshes[index].empty())
            rtcSetGeometryOccludedFilterFunction(g, occlusion_callback);
        attach(scene, g, index);
    }
    template <Kind kind>
    void attach_shapes(uint32_t id)
    {
        if (shapes<kind>(g_).size() == numbers_of<kind>(data_.wide).size()) return;
        RTCGeometry g = new_geometry(RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(g, static_cast<unsigned>(shapes<kind>(g_).size()));
        rtcSetGeometryUserData(g, &data_);
        rtcSetGeometryBoundsFunction(g, bounds_callback<kind>, nullptr);
        rtcSetGeometryIntersectFunction(g, intersect_callback<kind>);
        rtcSetGeometryOccludedFunction(g, occluded_callback<kind>);
        attach(scene_, g, id);
    }
    void attach_instance(uint32_t i)
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
        attach(scene_, g, first_instance_id(g_) + i);
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

    const Geometry& g_;
    EmbreeMode mode_;
    UserData data_;
    bool attached_ = false;  // anything; else there is nothing to search
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
    std::vector<RTCScene> mesh_scenes_;
    double build_seconds_ = 0;
    std::atomic<int64_t> bytes_{0};
};

}  // namespace

std::unique_ptr<Accelerator> make_embree(const Geometry& geometry, const std::string& isa, EmbreeMode mode)
{
    return std::make_unique<Embree>(geometry, isa, mode);
}

std::string embree_version()
{
    RTCDevice d = rtcNewDevice(nullptr);
    const auto v = rtcGetDeviceProperty(d, RTC_DEVICE_PROPERTY_VERSION);
    rtcReleaseDevice(d);
    return std::to_string(v / 10000) + "." + std::to_string(v / 100 % 100) + "." + std::to_string(v % 100);
}

}  // namespace lancer
