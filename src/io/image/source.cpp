#include "io/image/source.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/lanes/denormals.h"
#include "core/parallel.h"
#include "io/image/read.h"

namespace lancer {

ImageSource::ImageSource(unsigned threads) : most_threads_(std::max(threads, 1u)) {}

ImageSource::~ImageSource()
{
    std::deque<Job> left;
    {
        const std::lock_guard lock(mutex_);
        closing_ = true;
        left.swap(jobs_);
    }
    wake_.notify_all();
    for (Job& job : left) {
        job.promise.set_exception(
            std::make_exception_ptr(Error(ErrorKind::failed, {job.file}, "not read: the request was dropped")));
    }
    for (std::thread& t : threads_) t.join();
}

RasterFuture ImageSource::request(const std::string& file)
{
    std::unique_lock lock(mutex_);
    Known& known = known_[file];
    if (known.future.valid()) return known.future;
    Job job = {file, {}};
    RasterFuture future = job.promise.get_future().share();
    if (auto raster = known.raster.lock()) {
        job.promise.set_value(std::move(raster));
        return future;
    }
    known.future = future;
    jobs_.push_back(std::move(job));
    // All at once: starting one while another opens a library would make the caller wait.
    if (threads_.empty()) start_workers(lock);
    lock.unlock();
    wake_.notify_one();
    return future;
}

RasterSource ImageSource::source()
{
    return [this](const std::string& file) { return request(file); };
}

// Where the system grants no thread at all, the caller reads.
void ImageSource::start_workers(std::unique_lock<std::mutex>& lock)
{
    try {
        while (threads_.size() < most_threads_) threads_.emplace_back([this] { work(); });
    } catch (const std::system_error&) {
        if (!threads_.empty()) return;
        Job job = std::move(jobs_.front());
        jobs_.pop_front();
        lock.unlock();
        read(job);
        lock.lock();
    }
}

void ImageSource::work()
{
    set_flush_denormals();  // as every other thread
    std::unique_lock lock(mutex_);
    while (true) {
        wake_.wait(lock, [&] { return closing_ || !jobs_.empty(); });
        if (closing_) return;
        Job job = std::move(jobs_.front());
        jobs_.pop_front();
        lock.unlock();
        read(job);
        lock.lock();
    }
}

void ImageSource::read(Job& job)
{
    std::shared_ptr<const Raster> raster;
    std::exception_ptr failure;
    try {
        raster = read_raster(job.file);
    } catch (...) {
        failure = std::current_exception();
    }
    {
        const std::lock_guard lock(mutex_);
        Known& known = known_[job.file];
        known.raster = raster;
        known.future = {};
    }
    if (failure) {
        job.promise.set_exception(failure);
    } else {
        job.promise.set_value(std::move(raster));
    }
}

}  // namespace lancer
