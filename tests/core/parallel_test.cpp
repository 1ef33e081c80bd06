#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/lanes/denormals.h"

namespace lancer {
namespace {

// As the program does in the first line of main: before any worker is started.
const bool flushing = (set_flush_denormals(), true);

// Waits until `wanted` threads are inside at once; false after some seconds.
class Rendezvous {
public:
    explicit Rendezvous(unsigned wanted) : wanted_(wanted) {}
    bool wait()
    {
        ++arrived_;
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
        while (arrived_ < wanted_ && std::chrono::steady_clock::now() < end) std::this_thread::yield();
        return arrived_ >= wanted_;
    }

private:
    unsigned wanted_;
    std::atomic<unsigned> arrived_{0};
};

TEST(ParallelFor, VisitsEachIndexOnce)
{
    for (const unsigned threads : {1u, 2u, 7u})
        for (const size_t count : {size_t{0}, size_t{1}, size_t{2}, size_t{1000}}) {
            std::vector<std::atomic<int>> visits(count);
            with_threads(threads, [&] { parallel_for(count, [&](size_t i) { ++visits[i]; }); });
            for (const auto& v : visits) ASSERT_EQ(v, 1);
        }
    std::vector<std::atomic<int>> visits(100);
    parallel_for(visits.size(), [&](size_t i) { ++visits[i]; });  // also without with_threads
    for (const auto& v : visits) ASSERT_EQ(v, 1);
}

TEST(ParallelFor, HandsOutSmallIndicesFirst)
{
    std::vector<size_t> order;
    with_threads(1, [&] { parallel_for(100, [&](size_t i) { order.push_back(i); }); });
    for (size_t i = 0; i < 100; ++i) ASSERT_EQ(order[i], i);
}

TEST(WithThreads, RunsAsManyAtOnceAsAskedEvenBeyondTheCpus)
{
    const unsigned threads = available_threads() + 3;
    Rendezvous rendezvous(threads);
    std::atomic<bool> met{true};
    with_threads(threads, [&] {
        parallel_for(threads, [&](size_t) {
            if (!rendezvous.wait()) met = false;
        });
    });
    EXPECT_TRUE(met) << threads << " threads did not meet";
}

TEST(WithThreads, NeverRunsMore)
{
    for (const unsigned threads : {1u, 2u, 3u}) {
        std::atomic<unsigned> inside{0}, most{0};
        with_threads(threads, [&] {
            parallel_for(200, [&](size_t) {
                const unsigned now = ++inside;
                for (unsigned m = most; now > m && !most.compare_exchange_weak(m, now);) {
                }
                std::this_thread::sleep_for(std::chrono::microseconds(100));
                --inside;
            });
        });
        EXPECT_LE(most, threads);
    }
}

TEST(ParallelFor, ExceptionsReachTheCallerAndEndTheLoop)
{
    for (const unsigned threads : {1u, 2u, 5u}) {
        std::atomic<int> visits{0};
        EXPECT_THROW(with_threads(threads,
                                  [&] {
                                      parallel_for(100000, [&](size_t i) {
                                          ++visits;
                                          if (i == 10) throw std::runtime_error("ten");
                                          std::this_thread::sleep_for(std::chrono::microseconds(10));
                                      });
                                  }),
                     std::runtime_error);
        EXPECT_LT(visits, 50000) << threads;
        // And the next loop is whole again.
        std::atomic<int> after{0};
        with_threads(threads, [&] { parallel_for(50, [&](size_t) { ++after; }); });
        EXPECT_EQ(after, 50);
    }
}

TEST(WithThreads, AnExceptionLeavesTheOuterLimitInPlace)
{
    Rendezvous rendezvous(3);
    std::atomic<bool> met{true};
    with_threads(3, [&] {
        EXPECT_THROW(with_threads(1, [] { throw std::runtime_error("no"); }), std::runtime_error);
        parallel_for(3, [&](size_t) {
            if (!rendezvous.wait()) met = false;
        });
    });
    EXPECT_TRUE(met);
}

TEST(ParallelFor, Nests)
{
    constexpr size_t n = 30;
    std::vector<std::atomic<int>> visits(n * n);
    with_threads(4,
                 [&] { parallel_for(n, [&](size_t i) { parallel_for(n, [&](size_t j) { ++visits[i * n + j]; }); }); });
    for (const auto& v : visits) ASSERT_EQ(v, 1);
}

TEST(SetFlushDenormals, ReachesEveryWorker)
{
    ASSERT_TRUE(flushing);
    constexpr unsigned threads = 4;
    for (int round = 0; round < 3; ++round) {
        Rendezvous rendezvous(threads);
        std::mutex mutex;
        std::set<std::thread::id> seen;
        std::atomic<int> without{0}, kept{0};
        with_threads(threads, [&] {
            parallel_for(threads, [&](size_t) {
                rendezvous.wait();
                if (!flushes_denormals()) ++without;
                volatile float tiny = std::numeric_limits<float>::min();
                if (tiny * 0.5f != 0) ++kept;
                const std::lock_guard lock(mutex);
                seen.insert(std::this_thread::get_id());
            });
        });
        EXPECT_EQ(seen.size(), threads);
        EXPECT_EQ(without, 0);
        EXPECT_EQ(kept, 0);
    }
}

TEST(AvailableThreads, IsAtLeastOne)
{
    EXPECT_GE(available_threads(), 1u);
    EXPECT_LE(available_threads(), std::max(1u, std::thread::hardware_concurrency()));
}

}  // namespace
}  // namespace lancer
