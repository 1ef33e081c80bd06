// No ray allocates: after a first pass has warmed it up, a renderer's passes cost as many allocations with 64 samples a
// pixel as with 16. Counted by replacing the global operator new of this program.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "support/render.h"

namespace {

std::atomic<uint64_t> allocations{0};

void* counted_or_null(std::size_t size, std::size_t alignment) noexcept
{
    ++allocations;
    if (alignment <= alignof(std::max_align_t)) return std::malloc(size ? size : 1);
    return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}
void* counted(std::size_t size, std::size_t alignment)
{
    if (void* p = counted_or_null(size, alignment)) return p;
    throw std::bad_alloc();
}
// Out of line: inlined, g++ takes free() for the wrong partner of operator new.
[[gnu::noinline]] void release(void* p) { std::free(p); }

}  // namespace

void* operator new(std::size_t size) { return counted(size, 1); }
void* operator new[](std::size_t size) { return counted(size, 1); }
void* operator new(std::size_t size, std::align_val_t a) { return counted(size, static_cast<std::size_t>(a)); }
void* operator new[](std::size_t size, std::align_val_t a) { return counted(size, static_cast<std::size_t>(a)); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return counted_or_null(size, 1); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return counted_or_null(size, 1); }
void operator delete(void* p) noexcept { release(p); }
void operator delete[](void* p) noexcept { release(p); }
void operator delete(void* p, std::size_t) noexcept { release(p); }
void operator delete[](void* p, std::size_t) noexcept { release(p); }
void operator delete(void* p, const std::nothrow_t&) noexcept { release(p); }
void operator delete[](void* p, const std::nothrow_t&) noexcept { release(p); }
void operator delete(void* p, std::align_val_t) noexcept { release(p); }
void operator delete[](void* p, std::align_val_t) noexcept { release(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { release(p); }
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept { release(p); }

namespace lancer {
namespace {

uint64_t allocations_of(const std::function<void()>& f)
{
    const uint64_t before = allocations;
    f();
    return allocations - before;
}

TEST(Allocations, AreCounted)
{
    EXPECT_GE(allocations_of([] { std::vector<int>(10).push_back(1); }), 2u);
    EXPECT_EQ(allocations_of([] {}), 0u);
}

TEST(Allocations, DoNotGrowWithTheSamples)
{
    for (const NamedScene& s : all_test_scenes())
        for (const AnyIntegrator& integrator : {AnyIntegrator{Path{}}, AnyIntegrator{Direct{}}})
            with_threads(1, [&] {
                RendererConfig settings;
                settings.integrator = integrator;
                const Renderer renderer(build_scene(s.description), settings);
                const Camera camera = camera_of(s.description, renderer.scene(), 32, 24);
                Film film(32, 24, {0, 0, 32, 24});
                const std::vector<Tile> tiles = make_tiles(film.crop, 8);
                const auto pass = [&](uint32_t begin, uint32_t end) {
                    return allocations_of([&] { renderer.pass(camera, film, tiles, {begin, end}); });
                };
                pass(0, 64);  // warm: buffers have their size
                const uint64_t few = pass(64, 80), many = pass(80, 144);
                EXPECT_EQ(few, many) << s.name;
                EXPECT_LT(many, 4 * tiles.size() + 32) << s.name;  // of parallel_for and its tasks
            });
}

}  // namespace
}  // namespace lancer
