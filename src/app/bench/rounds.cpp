#include "app/bench/rounds.h"

#include <algorithm>
#include <cmath>

#include "app/bench/batches.h"
#include "core/clock.h"
#include "core/parallel.h"
#include "render/config.h"
#include "render/specialize.h"
#include "report/metrics/error_estimate.h"
#include "report/metrics/picture_pairs.h"

namespace lancer {
namespace {

constexpr size_t rays_at_once = 8 * rays_of_batch;  // of one thread, in a parallel loop
// Where answers and the stack lie relative to what is read decides which loads wait for stores: by a tenth of the time,
// one way in one process and another way in the next. Rounds move both, so that each run sees many places. Mytkowicz
// et al., "Producing Wrong Data Without Doing Anything Obviously Wrong!", ASPLOS 2009.
constexpr size_t most_shift = 101;          // hits of 40 bytes: a page
constexpr uint64_t bench_pixels = 96 * 54;  // a round of pictures takes about a second
constexpr uint32_t bench_tile = 16, pilot_spp = 64;

BenchGroup group_of(const std::string& family, const std::string& rays, const std::string& way, unsigned threads,
                    size_t methods)
{
    BenchGroup group{family, rays, way, threads, true, {}};
    group.times.resize(methods);
    return group;
}

void add(const Taken& taken, double items, BenchTimes& times)
{
    times.wall_ns.push_back(taken.wall / items);
    times.cpu_ns.push_back(taken.cpu / items);
}

PictureSize small_size(PictureSize size)
{
    const double aspect = aspect_of(size);
    const auto side = [](double x) { return static_cast<uint32_t>(std::max(1L, std::lround(x))); };
    return {side(std::sqrt(double(bench_pixels) * aspect)), side(std::sqrt(double(bench_pixels) / aspect))};
}

// Samples per pixel until the error, a root of a relative mean square, by the last doubling of a first picture: errors
// fall as one over the root of the samples, or faster.
double samples_for_error(const BenchPicture& p, const Renderer& renderer, double error)
{
    Film film(p.size.width, p.size.height, {0, 0, p.size.width, p.size.height});
    HalfBuffers halves;
    double spp = samples_per_block, reached = 1;
    for (uint32_t done = 0, next = samples_per_block; next <= pilot_spp; done = next, next *= 2) {
        renderer.pass(p.camera, film, p.tiles, {done, next});
        halves.look(film);
        if (halves.rel_mse()) spp = next, reached = std::sqrt(*halves.rel_mse());
        if (halves.rel_mse() && reached <= error) break;
    }
    return std::max(1.0, spp * (reached / error) * (reached / error));
}

template <class F>
[[gnu::noinline]] void with_shifted_stack(size_t bytes, const F& f)
{
    void* const below = __builtin_alloca(bytes + 16);
    asm volatile("" : : "g"(below) : "memory");
    f();
}

}  // namespace

void in_turns(size_t count, size_t round, const std::function<void(size_t)>& f)
{
    for (size_t k = 0; k < count; ++k) f((round + k) % count);
}

Taken time_pieces(size_t count, unsigned threads, const std::function<void(size_t)>& piece)
{
    const double begin = wall_ns();
    if (threads == 1) {
        const double cpu = thread_ns();
        for (size_t i = 0; i < count; ++i) piece(i);
        const double taken = thread_ns() - cpu;
        return {wall_ns() - begin, taken};
    }
    std::vector<double> cpu(count);
    parallel_for(count, [&](size_t i) {
        const double start = thread_ns();
        piece(i);
        cpu[i] = thread_ns() - start;
    });
    Taken taken{wall_ns() - begin, 0};
    for (const double ns : cpu) taken.cpu += ns / threads;
    return taken;
}

RayRounds::RayRounds(const std::vector<RaySet>& sets, const std::vector<BenchMethod>& methods, unsigned threads,
                     size_t slice)
    : sets_(sets), methods_(methods), threads_(threads), slice_(slice)
{
    for (const char* way : {"single", "batch"})
        for (const RaySet& set : sets)
            groups_.push_back(group_of("rays", std::string(set.kind), way, threads, methods.size()));
    // Every piece has a place of its own, whichever thread does it.
    hits_.resize(slice * threads + most_shift), occluded_.resize(slice * threads + most_shift);
}

RayRounds::Pieces RayRounds::pieces_of(const RaySet& set) const
{
    const size_t rays = std::min({rays_at_once, slice_, set.rays.size()});
    return {rays, set.rays.size() / rays, std::max<size_t>(1, slice_ / rays) * threads_};
}

Taken RayRounds::trace(const RayMethod& method, const RaySet& set, const Pieces& pieces, size_t first, size_t count)
{
    return time_pieces(count, threads_, [&](size_t i) {
        const auto some = std::span(set.rays).subspan((first + i) % pieces.in_set * pieces.rays, pieces.rays);
        if (set.occlusion)
            method.any(some, std::span(occluded_).subspan(shift_ + i * pieces.rays, pieces.rays), set.coherence);
        else
            method.closest(some, std::span(hits_).subspan(shift_ + i * pieces.rays, pieces.rays), set.coherence);
    });
}

void RayRounds::step()
{
    const size_t which = steps_ % groups_.size(), round = steps_ / groups_.size();
    const bool singly = which < sets_.size();
    const RaySet& set = sets_[which % sets_.size()];
    const Pieces pieces = pieces_of(set);
    const size_t first = round * pieces.of_round % pieces.in_set, before = pieces.of_round / 2;
    shift_ = round * 37 % most_shift;
    in_turns(methods_.size(), round, [&](size_t m) {
        const RayMethod method = singly ? methods_[m].single() : methods_[m].batch();
        // Others have had the caches: what comes before in the render brings the structure back, untimed.
        trace(method, set, pieces, first + pieces.in_set - before % pieces.in_set, before);
        Taken taken;
        with_shifted_stack(shift_ * 40, [&] { taken = trace(method, set, pieces, first, pieces.of_round); });
        add(taken, static_cast<double>(pieces.of_round * pieces.rays), groups_[which].times[m]);
    });
    ++steps_;
}

BuildRounds::BuildRounds(std::vector<BenchMethod>& methods, unsigned threads)
    : methods_(methods), threads_(threads), group_(group_of("build", "", "", threads, methods.size()))
{
    // Threads that wait for the others are part of what building takes.
    group_.by_cpu = threads == 1;
}

void BuildRounds::step()
{
    with_threads(threads_, [&] {
        in_turns(methods_.size(), steps_, [&](size_t m) {
            const double wall = wall_ns(), cpu = threads_ == 1 ? thread_ns() : all_ns();
            methods_[m].build();
            add({wall_ns() - wall, (threads_ == 1 ? thread_ns() : all_ns()) - cpu}, 1, group_.times[m]);
        });
    });
    ++steps_;
}

BenchPicture::BenchPicture(const BenchScene& of, const std::vector<BenchMethod>& all, double error)
    : scene(of),
      methods(all),
      size(small_size(of.settings().size)),
      config(configure(of.settings(), RenderOptions{}.batch)),
      camera(of.camera(size)),
      plan(of.renderer().plan(camera, size.width, size.height)),
      tiles(make_tiles({0, 0, size.width, size.height}, bench_tile))
{
    for (const BenchMethod& method : methods)
        own_.push_back(
            scene.is_bare() && method.accelerator() ? nullptr : method.renders_with(scene.renderer().scene().geometry));
    spp = samples_for_error(*this, scene.renderer(), error);
}

const Accelerator& BenchPicture::accelerator(size_t method) const
{
    return own_[method] ? *own_[method] : *methods[method].accelerator();
}

PictureRounds::PictureRounds(const BenchPicture& picture, unsigned threads)
    : picture_(picture),
      threads_(threads),
      workspaces_(threads == 1 ? 1 : 2 * threads),
      films_(picture.methods.size(),
             Film(picture.size.width, picture.size.height, {0, 0, picture.size.width, picture.size.height})),
      differing_(films_.size()),
      group_(group_of("picture", "", "", threads, picture.methods.size()))
{
}

void PictureRounds::step()
{
    const Renderer& renderer = picture_.scene.renderer();
    const SampleRange samples{static_cast<uint32_t>(steps_) * samples_per_block,
                              static_cast<uint32_t>(steps_ + 1) * samples_per_block};
    std::vector<TileKernel> kernels;
    for (size_t m = 0; m < films_.size(); ++m)
        kernels.push_back(make_tile_kernel(renderer.scene(), picture_.accelerator(m), renderer.integrator(),
                                           picture_.config.kernel, renderer.kernel_choice()));
    std::vector<Taken> taken(films_.size());
    const size_t at_once = workspaces_.size();
    for (size_t first = 0; first < picture_.tiles.size(); first += at_once) {
        const size_t n = std::min(at_once, picture_.tiles.size() - first);
        in_turns(films_.size(), steps_ + first / at_once, [&](size_t m) {
            const Taken some = time_pieces(n, threads_, [&](size_t i) {
                Counters counters;
                kernels[m](*picture_.plan, picture_.camera, films_[m], picture_.tiles[first + i], samples,
                           workspaces_[i], counters);
            });
            taken[m].wall += some.wall, taken[m].cpu += some.cpu;
        });
    }
    for (size_t m = 0; m < films_.size(); ++m) {
        add(taken[m], samples_per_block / picture_.spp, group_.times[m]);
        if (steps_ == 0) differing_[m] = differing_pixels(films_[0], films_[m]);
    }
    ++steps_;
}

}  // namespace lancer
