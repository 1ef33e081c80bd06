#include "core/parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <thread>

#include <sched.h>
#include <sys/resource.h>

#ifdef LANCER_STD_THREADS
#include <exception>
#include <mutex>
#include <system_error>
#include <vector>
#else
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/version.h>

#include "core/error.h"
#endif

#include "core/lanes/denormals.h"

namespace lancer {

unsigned available_threads()
{
    unsigned n = std::max(1u, std::thread::hardware_concurrency());
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0) n = static_cast<unsigned>(std::max(1, CPU_COUNT(&set)));
    // cgroup v2: "max 100000" or "150000 100000". TBB follows the affinity mask but not this quota.
    if (std::ifstream in("/sys/fs/cgroup/cpu.max"); in) {
        std::string quota;
        double period = 0;
        if (in >> quota >> period && quota != "max" && period > 0)
            n = std::min(n, static_cast<unsigned>(std::max(1.0, std::ceil(std::stod(quota) / period))));
    }
    return n;
}

#ifdef LANCER_STD_THREADS

namespace {
thread_local unsigned thread_limit = 1;
}

void with_threads(unsigned threads, const std::function<void()>& body)
{
    struct Restore {
        unsigned before = thread_limit;
        ~Restore() { thread_limit = before; }
    } const restore;
    thread_limit = std::max(1u, threads);
    body();
}

void parallel_for(size_t count, const std::function<void(size_t)>& body)
{
    std::atomic<size_t> next{0};
    std::mutex mutex;
    std::exception_ptr failure;
    auto work = [&] {
        set_flush_denormals();
        for (size_t i; (i = next.fetch_add(1)) < count;) {
            try {
                body(i);
            } catch (...) {
                std::lock_guard lock(mutex);
                if (!failure) failure = std::current_exception();
                next = count;
            }
        }
    };
    std::vector<std::thread> threads;
    for (size_t i = 1; i < std::min<size_t>(thread_limit, count); ++i) {
        try {
            threads.emplace_back(work);
        } catch (const std::system_error&) {
            break;  // the system grants no more: those there are do it all
        }
    }
    work();
    for (auto& t : threads) t.join();
    if (failure) std::rethrow_exception(failure);
}

std::string parallel_version() { return "std::thread"; }

#else

namespace {
// TBB up to 2021.8 ends the program where a worker finds no memory to begin with. Where the system sets a limit that
// the workers' stacks alone exceed, that would be a matter of luck.
void require_room_for(unsigned threads)
{
    const size_t stack = tbb::global_control::active_value(tbb::global_control::thread_stack_size);
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || threads <= limit.rlim_cur / stack)
        return;
    throw Error(ErrorKind::failed, {},
                "the stacks of " + std::to_string(threads) + " threads need more than the " +
                    std::to_string(limit.rlim_cur >> 20) +
                    " MiB of address space that the system grants; fewer --threads need less");
}
}  // namespace

void with_threads(unsigned threads, const std::function<void()>& body)
{
    threads = std::max(1u, threads);
    require_room_for(threads);
    // The arena alone would stay at the number of CPUs and warn; the control lifts that limit.
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    tbb::task_arena arena(static_cast<int>(threads));
    arena.execute(body);
}

void parallel_for(size_t count, const std::function<void(size_t)>& body)
{
    const auto workers =
        std::min<size_t>(count, static_cast<size_t>(std::max(1, tbb::this_task_arena::max_concurrency())));
    std::atomic<size_t> next{0};
    tbb::parallel_for(
        size_t{0}, workers,
        [&](size_t) {
            try {
                for (size_t i; (i = next.fetch_add(1)) < count;) body(i);
            } catch (...) {
                next = count;  // nobody waits for the rest
                throw;
            }
        },
        tbb::simple_partitioner{});
}

std::string parallel_version() { return std::string("TBB ") + TBB_runtime_version(); }

#endif

}  // namespace lancer
