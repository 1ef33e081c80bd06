// Reads pictures in the background while the scene is being built.
#pragma once

#include <condition_variable>
#include <deque>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/raster.h"

namespace lancer {

// Reads each picture once for all concurrent requests and keeps none: a picture lives as long as someone holds it or
// its future. Threads start with the first request.
class ImageSource {
public:
    // At most so many files are read at once, >= 1.
    explicit ImageSource(unsigned threads);
    // Finishes pictures that are being read; requests that have not begun fail with an Error.
    ~ImageSource();
    ImageSource(const ImageSource&) = delete;
    ImageSource& operator=(const ImageSource&) = delete;

    // The future's get() throws as read_raster(). Thread-safe.
    RasterFuture request(const std::string& file);
    // request(), for Scene::begin. Must not be called when *this is gone; the futures may be waited for even then.
    RasterSource source();

private:
    struct Job {
        std::string file;
        std::promise<std::shared_ptr<const Raster>> promise;
    };
    // A picture that is being read, or that someone still holds.
    struct Known {
        RasterFuture future;
        std::weak_ptr<const Raster> raster;
    };
    void work();
    void read(Job& job);
    void start_workers(std::unique_lock<std::mutex>& lock);

    const unsigned most_threads_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<Job> jobs_;
    std::map<std::string, Known> known_;
    bool closing_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace lancer
