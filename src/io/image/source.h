// Reads pictures in the background while the scene is being built.
#pragma once

#include <condition_variable>
#include <future>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/raster.h"

namespace lancer {

// Reads each picture once for all concurrent requests and keeps none: a picture lives as long as someone holds it or
// its future. Threads start with the first request. Headers of all requested files are read before pixels.
class ImageSource {
public:
    static constexpr uint64_t no_limit = UINT64_MAX;

    // At most so many files are read at once, >= 1. ahead: as many bytes of pictures may be held that nobody demands;
    // further ones wait until some are let go of or they are demanded.
    explicit ImageSource(unsigned threads, uint64_t ahead = no_limit);
    // Finishes pictures that are being read; requests that have not begun fail with an Error.
    ~ImageSource();
    ImageSource(const ImageSource&) = delete;
    ImageSource& operator=(const ImageSource&) = delete;

    // The future's get() throws as read_raster(). Thread-safe.
    RasterFuture request(const std::string& file);
    // Of a file that was requested; waits for it. Nothing if it cannot be read. Thread-safe.
    std::optional<RasterHeader> header(const std::string& file);
    // Someone waits for the picture now: it is read whatever else is held. Thread-safe.
    void demand(const std::string& file);
    // request(), for Scene::begin. Must not be called when *this is gone; the futures may be waited for even then.
    RasterSource source();

private:
    using HeaderFuture = std::shared_future<std::optional<RasterHeader>>;
    struct Job {
        std::string file;
        std::promise<std::shared_ptr<const Raster>> raster;
        std::promise<std::optional<RasterHeader>> header;
        uint64_t bytes = 0;  // of the picture, as the header says
        bool is_demanded = false;
    };
    using Jobs = std::list<Job>;
    // A picture that is being read, or that someone still holds.
    struct Known {
        RasterFuture future;
        HeaderFuture header;
        std::weak_ptr<const Raster> raster;
    };
    // Outlives the source: pictures that are let go of later still count down.
    struct Shared {
        std::mutex mutex;
        std::condition_variable wake;
        uint64_t held = 0;  // bytes of pictures that are being read or held
    };
    void work();
    static void read_header(Job& job);
    void read(Job& job);
    Jobs::iterator find_ready();
    void start_workers(std::unique_lock<std::mutex>& lock);

    const unsigned most_threads_;
    const uint64_t ahead_;
    const std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
    Jobs fresh_, waiting_;  // without header, and with
    std::map<std::string, Known> known_;
    bool closing_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace lancer
