// Pictures read in the background, while the scene around them is still being built.
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

// Reads each picture once for all who ask for it at a time, and keeps none: a picture lives as long as somebody holds
// it or its future. Threads start with the first picture; a scene without any costs nothing.
class ImageSource {
public:
    // At most so many files are read at once, >= 1.
    explicit ImageSource(unsigned threads);
    // Finishes what is being read; what nobody has begun fails with an Error.
    ~ImageSource();
    ImageSource(const ImageSource&) = delete;
    ImageSource& operator=(const ImageSource&) = delete;

    // Its get() throws what read_raster() throws. May be called from several threads.
    RasterFuture request(const std::string& file);
    // request(), for Scene::begin. Must not be called when *this is gone; the futures may be waited for even then.
    RasterSource source();

private:
    struct Job {
        std::string file;
        std::promise<std::shared_ptr<const Raster>> promise;
    };
    // A picture while it is on its way, or as long as somebody else keeps it.
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
