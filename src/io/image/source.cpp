#include "io/image/source.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/lanes/denormals.h"
#include "core/parallel.h"
#include "io/image/read.h"

namespace lancer {

ImageSource::ImageSource(unsigned threads, uint64_t ahead) : most_threads_(std::max(threads, 1u)), ahead_(ahead) {}

ImageSource::~ImageSource()
{
    {
        const std::lock_guard lock(shared_->mutex);
        closing_ = true;
    }
    shared_->wake.notify_all();
    for (std::thread& t : threads_) t.join();
    for (Job& job : fresh_) job.header.set_value({});
    waiting_.splice(waiting_.end(), fresh_);
    for (Job& job : waiting_) {
        job.raster.set_exception(
            std::make_exception_ptr(Error(ErrorKind::failed, {job.file}, "not read: the request was dropped")));
    }
}

RasterFuture ImageSource::request(const std::string& file)
{
    std::unique_lock lock(shared_->mutex);
    Known& known = known_[file];
    if (known.future.valid()) return known.future;
    Job job{.file = file, .raster = {}, .header = {}};
    RasterFuture future = job.raster.get_future().share();
    if (auto raster = known.raster.lock()) {
        job.raster.set_value(std::move(raster));
        return future;
    }
    known.future = future;
    known.header = job.header.get_future().share();
    fresh_.push_back(std::move(job));
    // All at once: starting one while another opens a library would make the caller wait.
    if (threads_.empty()) start_workers(lock);
    lock.unlock();
    shared_->wake.notify_one();
    return future;
}

std::optional<RasterHeader> ImageSource::header(const std::string& file)
{
    HeaderFuture found;
    {
        const std::lock_guard lock(shared_->mutex);
        if (const auto it = known_.find(file); it != known_.end()) found = it->second.header;
    }
    return found.valid() ? found.get() : std::nullopt;
}

void ImageSource::demand(const std::string& file)
{
    {
        const std::lock_guard lock(shared_->mutex);
        for (Jobs* jobs : {&fresh_, &waiting_})
            for (Job& job : *jobs)
                if (job.file == file) job.is_demanded = true;
    }
    shared_->wake.notify_all();
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
        Jobs job;
        job.splice(job.end(), fresh_, fresh_.begin());
        lock.unlock();
        read_header(job.front());
        read(job.front());
        lock.lock();
    }
}

// A picture that may be read now: the first that is demanded, else the first for which there is room.
ImageSource::Jobs::iterator ImageSource::find_ready()
{
    const auto demanded = std::find_if(waiting_.begin(), waiting_.end(), [](const Job& j) { return j.is_demanded; });
    if (demanded != waiting_.end()) return demanded;
    const uint64_t room = ahead_ - std::min(shared_->held, ahead_);
    return std::find_if(waiting_.begin(), waiting_.end(), [&](const Job& j) { return j.bytes <= room; });
}

void ImageSource::work()
{
    set_flush_denormals();  // as every other thread
    std::unique_lock lock(shared_->mutex);
    while (true) {
        shared_->wake.wait(lock, [&] { return closing_ || !fresh_.empty() || find_ready() != waiting_.end(); });
        if (closing_) return;
        Jobs job;
        if (!fresh_.empty()) {
            job.splice(job.end(), fresh_, fresh_.begin());
            lock.unlock();
            read_header(job.front());
            lock.lock();
            waiting_.splice(waiting_.end(), job);
            shared_->wake.notify_one();
            continue;
        }
        job.splice(job.end(), waiting_, find_ready());
        shared_->held += job.front().bytes;
        lock.unlock();
        read(job.front());
        job.clear();  // before the lock: it may be the last to hold the picture, which is counted under the lock
        lock.lock();
    }
}

// What is wrong with the file is found again, and told, when its pixels are read.
void ImageSource::read_header(Job& job)
{
    std::optional<RasterHeader> header;
    try {
        header = read_raster_header(job.file);
        job.bytes = header->bytes();
    } catch (const std::exception&) {
        header.reset();
    }
    job.header.set_value(header);
}

void ImageSource::read(Job& job)
{
    const auto let_go = [shared = shared_, bytes = job.bytes] {
        {
            const std::lock_guard lock(shared->mutex);
            shared->held -= std::min(bytes, shared->held);
        }
        shared->wake.notify_all();
    };
    std::shared_ptr<const Raster> raster;
    std::exception_ptr failure;
    try {
        auto owner = read_raster(job.file);
        const Raster* const place = owner.get();
        raster = {place, [owner = std::move(owner), let_go](const Raster*) mutable {
                      owner.reset();
                      let_go();
                  }};
    } catch (...) {
        failure = std::current_exception();
        let_go();
    }
    {
        const std::lock_guard lock(shared_->mutex);
        Known& known = known_[job.file];
        known.raster = raster;
        known.future = {};
    }
    if (failure) {
        job.raster.set_exception(failure);
    } else {
        job.raster.set_value(std::move(raster));
    }
}

}  // namespace lancer
