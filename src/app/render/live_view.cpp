#include "app/render/live_view.h"

#include <algorithm>
#include <exception>

#include "app/console.h"
#include "app/render/outputs.h"

namespace lancer {
namespace {

// Of the pixels in one packet: large enough for a large picture to need few, small enough for a slow line to carry one
// within the time limit of a packet.
constexpr size_t bytes_per_packet = size_t{1} << 18;
// Between two rounds of updates: a band of pixels gets many tiles in that time, and nobody sees more pictures a second.
constexpr auto pause = std::chrono::milliseconds(100);
// For the rest of the picture after the render.
constexpr auto time_to_finish = std::chrono::seconds(5);

std::string in_brackets_if_v6(const std::string& host)
{
    return host.find(':') == std::string::npos ? host : "[" + host + "]";
}

}  // namespace

LiveView::LiveView(const RenderOptions& options, const Film& film, std::vector<std::string>& warnings)
    : warnings_(warnings)
{
    if (!options.display) return;
    const auto& [host, port] = *options.display;
    place_ = in_brackets_if_v6(host) + ":" + std::to_string(port);
    image_ = to_image(film);
    const size_t bytes_per_row = static_cast<size_t>(image_.data.width()) * sizeof(Color);
    rows_ = static_cast<int32_t>(std::max<size_t>(1, bytes_per_packet / bytes_per_row));
    news_in_.resize(static_cast<size_t>((image_.data.height() + rows_ - 1) / rows_));
    std::string problem;
    try {
        problem = server_.connect(host, port);
        if (problem.empty())
            problem = server_.create(options.outputs.front(), image_.display.width(), image_.display.height());
        if (problem.empty()) thread_ = std::thread([this] { serve(); });
    } catch (const std::exception& e) {  // no thread to be had
        problem = e.what();
    }
    is_on_ = problem.empty();
    if (!is_on_)
        say("no viewer at " + place_ + ": " + problem +
            "; start tev there first, or name the host and port that it listens at; this render goes on without it");
}

LiveView::~LiveView()
{
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        is_closing_ = true;
        deadline_ = Clock::now() + time_to_finish;
    }
    news_.notify_one();
    thread_.join();
    if (!problem_.empty()) say(problem_);
}

void LiveView::tile_done(const Film& film, const Tile& tile, Progress& progress)
{
    if (!is_on_.load(std::memory_order_relaxed)) return;
    {
        const std::lock_guard lock(mutex_);
        if (!is_on_) return;
        if (!problem_.empty()) {
            is_on_ = false;
            progress.clear();
            say(problem_);
            problem_.clear();
            return;
        }
        for (uint32_t y = tile.y0; y < tile.y1; ++y)
            for (uint32_t x = tile.x0; x < tile.x1; ++x)
                image_.at(static_cast<int32_t>(x), static_cast<int32_t>(y)) = film.whole(film.index(x, y)).mean();
        const auto band_of = [this](uint32_t y) { return (static_cast<int32_t>(y) - image_.data.y0) / rows_; };
        for (auto i = band_of(tile.y0); i <= band_of(tile.y1 - 1); ++i) news_in_[static_cast<size_t>(i)] = true;
    }
    news_.notify_one();
}

Window LiveView::band(size_t i) const
{
    const Window& all = image_.data;
    const int32_t y0 = all.y0 + static_cast<int32_t>(i) * rows_;
    return {all.x0, y0, all.x1, std::min(y0 + rows_, all.y1)};
}

// Runs on the thread: waits for news and sends them, until there is nothing more to come or a problem.
void LiveView::serve()
{
    std::unique_lock lock(mutex_);
    const auto any_news = [this] { return std::find(news_in_.begin(), news_in_.end(), true) != news_in_.end(); };
    for (;;) {
        news_.wait(lock, [&] { return is_closing_ || any_news(); });
        if (!any_news()) return;
        try {
            problem_ = send_news(lock);
        } catch (const std::exception& e) {  // memory
            if (!lock) lock.lock();
            problem_ = e.what();
        }
        if (!problem_.empty()) {
            problem_ = "lost the viewer at " + place_ + " after " + std::to_string(updates_) + " updates: " + problem_ +
                       "; the files will have the rest of the picture, the render goes on";
            return;
        }
        news_.wait_for(lock, pause, [this] { return is_closing_; });
    }
}

// Every band that has news, without the lock while it is on its way.
std::string LiveView::send_news(std::unique_lock<std::mutex>& lock)
{
    for (size_t i = 0; i < news_in_.size(); ++i) {
        if (!news_in_[i]) continue;
        if (is_closing_ && Clock::now() > deadline_) return "it reads too slowly";
        news_in_[i] = false;
        const Window window = band(i);
        const auto begin = image_.pixels.begin() + (&image_.at(window.x0, window.y0) - image_.pixels.data());
        const std::vector<Color> pixels(begin, begin + static_cast<std::ptrdiff_t>(window.area()));
        lock.unlock();
        std::string problem = server_.update(window, pixels);
        lock.lock();
        if (!problem.empty()) return problem;
        ++updates_;
    }
    return "";
}

void LiveView::say(const std::string& problem)
{
    warnings_.push_back("warning: --display-server: " + problem);
    print_problem(warnings_.back());
}

}  // namespace lancer
