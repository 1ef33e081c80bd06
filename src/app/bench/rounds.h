// What `lancer bench` times, in rounds: each of them has every method once, one shortly after the other, in an order
// that turns from round to round.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/bench/bench_scene.h"
#include "app/bench/methods.h"
#include "core/film.h"
#include "report/bench/run.h"

namespace lancer {

// f(i) for each of `count` methods, beginning with another one in each round.
void in_turns(size_t count, size_t round, const std::function<void(size_t)>& f);

// Nanoseconds of the clock, and of the CPU within the work of the threads that did it: what waits for the others, or
// for a CPU that somebody else has, does not count.
struct Taken {
    double wall = 0, cpu = 0;
};
// Does the pieces of work on the calling thread or, with more threads, in a parallel loop.
Taken time_pieces(size_t count, unsigned threads, const std::function<void(size_t)>& piece);

// How long each kind of ray takes.
class RayRounds {
public:
    // slice: rays of a round, for each thread. All must outlive it.
    RayRounds(const std::vector<RaySet>& sets, const std::vector<BenchMethod>& methods, unsigned threads, size_t slice);

    // The next round, of one kind and one way to ask.
    void step();
    const std::vector<BenchGroup>& groups() const { return groups_; }
    size_t rounds() const { return steps_ / groups_.size(); }  // of all kinds and ways

private:
    // A set in pieces: rays in each, pieces in the set, and pieces of one round.
    struct Pieces {
        size_t rays, in_set, of_round;
    };
    Pieces pieces_of(const RaySet& set) const;
    Taken trace(const RayMethod& method, const RaySet& set, const Pieces& pieces, size_t first, size_t count);

    const std::vector<RaySet>& sets_;
    const std::vector<BenchMethod>& methods_;
    unsigned threads_;
    size_t slice_;
    size_t steps_ = 0, shift_ = 0;
    std::vector<BenchGroup> groups_;  // of each kind singly, then in batches
    std::vector<Hit> hits_;
    std::vector<uint8_t> occluded_;
};

// How long building takes. What is built takes the place of what was there before, so that chance in where it lies in
// memory is part of what all other rounds see.
class BuildRounds {
public:
    BuildRounds(std::vector<BenchMethod>& methods, unsigned threads);
    void step();
    const BenchGroup& group() const { return group_; }

private:
    std::vector<BenchMethod>& methods_;
    unsigned threads_;
    size_t steps_ = 0;
    BenchGroup group_;
};

// A picture of the scene by each method, as a render draws it.
struct BenchPicture {
    // Accelerators of the methods are built now, where they are not what rays are asked of. Must be called inside
    // with_threads.
    BenchPicture(const BenchScene& scene, const std::vector<BenchMethod>& methods, double error);

    const BenchScene& scene;
    const std::vector<BenchMethod>& methods;
    PictureSize size;
    RendererConfig config;
    Camera camera;
    std::shared_ptr<const SamplingPlan> plan;
    std::vector<Tile> tiles;
    double spp = 0;  // samples per pixel for the error, by what a first picture shows

    const Accelerator& accelerator(size_t method) const;

private:
    std::vector<std::unique_ptr<Accelerator>> own_;  // null: the method's own structure
};

class PictureRounds {
public:
    PictureRounds(const BenchPicture& picture, unsigned threads);

    // The next samples of each pixel by every method, tile by tile in turns.
    void step();
    // Times of a picture of so many samples that it has the error.
    const BenchGroup& group() const { return group_; }
    // Pixels of a method's first samples that are not those of the first method, to the bit.
    size_t differing(size_t method) const { return differing_[method]; }

private:
    const BenchPicture& picture_;
    unsigned threads_;
    size_t steps_ = 0;
    std::vector<Workspace> workspaces_;  // of the tiles that are drawn at once
    std::vector<Film> films_;
    std::vector<size_t> differing_;  // of each method
    BenchGroup group_;
};

}  // namespace lancer
