// The accelerator around a hand-written triangle tree: it adds instances, spheres, planes, the alpha test and the order
// of equal hits. One tree contains the triangles of all non-instanced meshes; each instanced mesh has a tree in its own
// space; a binary tree contains the boxes of instances and spheres; planes are a list.
#pragma once

#include <chrono>
#include <optional>

#include "geometry/accel.h"
#include "geometry/bvh2/builder.h"
#include "geometry/bvh8/interleaved.h"
#include "geometry/bvh8/packets.h"
#include "geometry/candidate_hits.h"
#include "geometry/object_boxes.h"
#include "geometry/packet_tree.h"
#include "geometry/refine_all.h"

namespace lancer {

template <TriangleTree Tree>
class TreeAccelerator final : public Accelerator {
public:
    explicit TreeAccelerator(const Geometry& geometry) : g_(geometry)
    {
        const auto start = std::chrono::steady_clock::now();
        std::vector<uint32_t> plain;
        placed_.resize(g_.meshes.size());
        for (uint32_t i = 0; i < g_.meshes.size(); ++i) {
            if (g_.meshes[i].triangles.empty()) continue;
            if (g_.meshes[i].instanced)
                placed_[i].emplace(g_, std::vector{i});
            else
                plain.push_back(i);
        }
        if (!plain.empty()) plain_.emplace(g_, std::move(plain));
        build_objects();
        build_seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    Hit closest(const Ray& ray) const override { return refine(g_, ray, find(ray)); }
    bool any(const Ray& ray) const override
    {
        if (!is_traceable(ray)) return false;
        return occluded_by_plane(ray) || (plain_ && occluded_in(*plain_, ray, ray, Hit::no_instance)) ||
               occluded_by_object(ray);
    }
    void closest(std::span<const Ray> rays, std::span<Hit> hits, [[maybe_unused]] Coherence coherence) const override
    {
        if constexpr (PacketTree<Tree>)
            closest_by_packets(rays, hits);
        else if constexpr (is_bvh8)
            coherence == Coherence::coherent ? closest_batch<Bvh8Packets>(rays, hits)
                                             : closest_batch<Bvh8Interleaved>(rays, hits);
        else
            closest_one_by_one(rays, hits);
        refine_all(g_, rays, hits);
    }
    void any(std::span<const Ray> rays, std::span<uint8_t> occluded) const override
    {
        if constexpr (PacketTree<Tree>)
            any_by_packets(rays, occluded);
        else
            for (size_t i = 0; i < rays.size(); ++i) occluded[i] = TreeAccelerator::any(rays[i]);
    }
    AccelStats stats() const override
    {
        AccelStats s{build_seconds_, objects_.bytes()};
        if (plain_) s.bytes += plain_->tree.bytes(), s.sah_cost = plain_->tree.sah_cost();
        for (const auto& p : placed_)
            if (p) s.bytes += p->tree.bytes();
        return s;
    }

private:
    // A Bvh8 takes batches of rays and returns leaf hints.
    static constexpr bool is_bvh8 = std::is_same_v<Tree, Bvh8>;
    // Whether the tree reports nearer triangles only, at approximate distances.
    static constexpr bool orders_hits = is_bvh8 || PacketTree<Tree>;
    struct Space {
        TriangleSet triangles;
        Tree tree;
        Space(const Geometry& g, std::vector<uint32_t> meshes) : triangles(g, std::move(meshes)), tree(triangles) {}
    };

    // closest() without refine().
    Hit find(const Ray& ray) const
    {
        Hit best;
        if (!is_traceable(ray)) return best;
        find_plane(ray, best);
        if (plain_) best.leaf_hint = find_in(*plain_, ray, ray, Hit::no_instance, best);
        find_object(ray, best);
        return best;
    }
    void closest_one_by_one(std::span<const Ray> rays, std::span<Hit> hits) const
    {
        for (size_t i = 0; i < rays.size(); ++i) hits[i] = find(rays[i]);
    }
    // How: Bvh8Interleaved or Bvh8Packets.
    template <class How>
    void closest_batch(std::span<const Ray> rays, std::span<Hit> hits) const
    {
        std::array<float, Bvh8Interleaved::most> t_max;
        std::array<uint32_t, Bvh8Interleaved::most> leaf_hints;
        for (size_t first = 0; first < rays.size(); first += Bvh8Interleaved::most) {
            const size_t n = std::min(Bvh8Interleaved::most, rays.size() - first);
            const auto some = rays.subspan(first, n);
            const auto best = hits.subspan(first, n);
            for (size_t i = 0; i < n; ++i) {
                best[i] = {};
                leaf_hints[i] = Ray::no_leaf_hint;
                t_max[i] = -1;
                if (!is_traceable(some[i])) continue;
                find_plane(some[i], best[i]);
                t_max[i] = reach(some[i], best[i]);
            }
            if (plain_)
                How(plain_->tree)
                    .closest(some, std::span(t_max).first(n), leaf_hints, [&](uint32_t i, uint32_t number, float t) {
                        return asking(*plain_, some[i], Hit::no_instance, best[i])(number, t);
                    });
            for (size_t i = 0; i < n; ++i) {
                if (t_max[i] < 0) continue;
                best[i].leaf_hint = leaf_hints[i];
                find_object(some[i], best[i]);
            }
        }
    }
    void closest_by_packets(std::span<const Ray> rays, std::span<Hit> hits) const
    {
        // A plane is compared with triangles as they are found: their distances are approximate afterwards.
        if (!g_.planes.empty()) return closest_one_by_one(rays, hits);
        std::fill(hits.begin(), hits.end(), Hit{});
        if (plain_)
            for_each_packet(rays, [&](std::span<const uint32_t> which) {
                const ShearedPacket packet(rays, which);
                PacketHits best(packet.rays.t_max);
                plain_->tree.closest(packet, best, [&](Mask8 met, uint32_t number, Float8 t) {
                    return met & ~passed(rays, which, met, number, t);
                });
                for (size_t i = 0; i < which.size(); ++i) {
                    if (best.number[i] == PacketHits::none) continue;
                    const TriangleSet::Id id = plain_->triangles.id(best.number[i]);
                    hits[which[i]] = {best.t(i), Hit::no_instance, id.mesh, id.triangle, {}, Kind::triangle};
                }
            });
        if (is_plain()) return;
        for (size_t i = 0; i < rays.size(); ++i)
            if (is_traceable(rays[i])) find_object(rays[i], hits[i]);
    }
    void any_by_packets(std::span<const Ray> rays, std::span<uint8_t> occluded) const
    {
        std::fill(occluded.begin(), occluded.end(), uint8_t{0});
        if (!is_plain())
            for (size_t i = 0; i < rays.size(); ++i)
                occluded[i] = is_traceable(rays[i]) && (occluded_by_plane(rays[i]) || occluded_by_object(rays[i]));
        if (plain_)
            for_each_packet(rays, [&](std::span<const uint32_t> which) {
                const uint32_t stopped = plain_->tree.any(
                    ShearedPacket(rays, which),
                    [&](Mask8 met, uint32_t number, Float8 t) { return met & ~passed(rays, which, met, number, t); });
                for_each_lane(stopped, [&](uint32_t i) { occluded[which[i]] = 1; });
            });
    }
    // Lanes that pass the alpha test at a triangle of plain_.
    Mask8 passed(std::span<const Ray> rays, std::span<const uint32_t> which, Mask8 met, uint32_t number, Float8 t) const
    {
        if (!g_.alpha_test.passes_through) return Mask8{};
        const TriangleSet::Id id = plain_->triangles.id(number);
        uint32_t through = 0;
        for_each_lane(movemask(met), [&](uint32_t i) {
            const Hit hit{t[i], Hit::no_instance, id.mesh, id.triangle, {}, Kind::triangle};
            through |= uint32_t{passes_through(g_, rays[which[i]], hit)} << i;
        });
        return lanes_of(through);
    }

    bool is_plain() const { return g_.planes.empty() && g_.instances.empty() && g_.spheres.empty(); }
    static float reach(const Ray& ray, const Hit& best) { return best ? best.t : ray.t_max; }
    static Ray up_to(const Ray& ray, const Hit& best)
    {
        Ray rest = ray;
        rest.t_max = reach(ray, best);
        return rest;
    }
    void find_plane(const Ray& ray, Hit& best) const
    {
        for (uint32_t i = 0; i < g_.planes.size(); ++i)
            take(first_opaque_hit<Kind::plane>(g_, i, up_to(ray, best)), best);
    }
    static void take(const Hit& hit, Hit& best)
    {
        if (hit && is_nearer(hit, best)) best = hit;
    }
    // Returns Hit::leaf_hint if the tree has one. local: the ray in the space of the triangles.
    uint32_t find_in(const Space& s, const Ray& ray, const Ray& local, uint32_t instance, Hit& best) const
    {
        float t_max = reach(ray, best);
        if constexpr (is_bvh8) return s.tree.closest(local, t_max, asking(s, ray, instance, best)).bits();
        s.tree.closest(local, t_max, asking(s, ray, instance, best));
        return Ray::no_leaf_hint;
    }
    static bool is_of(const Hit& best, uint32_t instance)
    {
        return best.kind == Kind::triangle && best.instance == instance;
    }
    // The callback of the tree for candidate triangles.
    auto asking(const Space& s, const Ray& ray, uint32_t instance, Hit& best) const
    {
        return [&, instance](uint32_t number, float t) {
            const TriangleSet::Id id = s.triangles.id(number);
            const Hit hit{t, instance, id.mesh, id.triangle, {}, Kind::triangle};
            if (!(orders_hits && is_of(best, instance)) && !is_nearer(hit, best)) return false;
            if (passes_through(g_, ray, hit)) return false;
            best = hit;
            return true;
        };
    }
    void find_object(const Ray& ray, Hit& best) const
    {
        // The distance is only computed if the triangle is compared with another kind of hit.
        bool is_known = !orders_hits;
        const auto farthest = [&] { return reach(ray, best) * (is_known ? 1 : 1 + 2 * most_distance_error); };
        objects_.closest(ray, farthest(), [&](uint32_t object, uint32_t, float) {
            if (!is_known && best.kind == Kind::triangle) best.t = refine(g_, ray, best).t;
            is_known = true;
            if (is_sphere(object))
                take(first_opaque_hit<Kind::sphere>(g_, sphere(object), up_to(ray, best)), best);
            else if (const Ray local = into_mesh(ray, object); is_traceable(local)) {
                find_in(*placed_[g_.instances[object].mesh], ray, local, object, best);
                is_known = !(orders_hits && is_of(best, object));
            }
            return farthest();
        });
    }

    bool occluded_by_plane(const Ray& ray) const
    {
        for (uint32_t i = 0; i < g_.planes.size(); ++i)
            if (first_opaque_hit<Kind::plane>(g_, i, ray)) return true;
        return false;
    }
    bool occluded_in(const Space& s, const Ray& ray, const Ray& local, uint32_t instance) const
    {
        return s.tree.any(local, [&](uint32_t number, float t) {
            const TriangleSet::Id id = s.triangles.id(number);
            return !passes_through(g_, ray, {t, instance, id.mesh, id.triangle, {}, Kind::triangle});
        });
    }
    bool occluded_by_object(const Ray& ray) const
    {
        return objects_.any(ray, [&](uint32_t object, uint32_t) {
            if (is_sphere(object)) return static_cast<bool>(first_opaque_hit<Kind::sphere>(g_, sphere(object), ray));
            const Ray local = into_mesh(ray, object);
            return is_traceable(local) && occluded_in(*placed_[g_.instances[object].mesh], ray, local, object);
        });
    }

    // Objects are numbered: instances first, then spheres.
    bool is_sphere(uint32_t object) const { return object >= g_.instances.size(); }
    uint32_t sphere(uint32_t object) const { return object - static_cast<uint32_t>(g_.instances.size()); }
    void build_objects()
    {
        std::vector<FloatBox> meshes(g_.meshes.size());
        for (size_t i = 0; i < placed_.size(); ++i)
            if (placed_[i]) meshes[i] = box_of(placed_[i]->triangles);
        std::vector<BoxedPrimitive> boxes;
        uint32_t object = 0;
        for (const Instance& i : g_.instances) {
            FloatBox box;
            for_each_place(i.to_world, g_.motion.instances, object, [&](const Transform& to_world) {
                if (!meshes[i.mesh].empty()) box.grow(box_of(meshes[i.mesh], to_world));
            });
            if (!box.empty()) boxes.emplace_back(box, object);
            ++object;
        }
        for (uint32_t i = 0; i < g_.spheres.size(); ++i) {
            FloatBox box;
            for_each_place(g_.spheres[i], g_.motion.spheres, i, [&](const Sphere& s) { box.grow(box_of(s)); });
            boxes.emplace_back(box, object++);
        }
        BuiltTree built = build_sah(std::move(boxes), 1);
        built.tree.relabel_leaves([&](uint32_t first, uint32_t) { return built.order[first]; });
        objects_ = std::move(built.tree);
    }
    Ray into_mesh(const Ray& ray, uint32_t instance) const
    {
        const InstanceAt placed = g_.instance_at(instance, ray.time);
        const Transform& m = placed->to_mesh;
        Ray local = ray;
        local.org = to_float(m.point(to_double(ray.org)));
        local.dir = to_float(m.vector(to_double(ray.dir)));
        local.leaf_hint = Ray::no_leaf_hint;
        return local;
    }

    const Geometry& g_;
    std::optional<Space> plain_;
    std::vector<std::optional<Space>> placed_;  // per mesh
    BinaryTree objects_;                        // `first` of a leaf is the object
    double build_seconds_ = 0;
};

}  // namespace lancer
