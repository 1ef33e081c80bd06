// The picture of a render in a viewer while it grows (--display-server). It only reads the film, and on a thread of its
// own it sends what is new: the render never waits for the viewer, and a viewer that is slow gets fewer states of the
// picture, not older ones. Whatever goes wrong with it is said once, as a warning, and the render goes on.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "app/options/options.h"
#include "app/render/progress.h"
#include "core/image.h"
#include "io/net/display_server.h"

namespace lancer {

class LiveView {
public:
    // Connects, within a time limit, if the options name a viewer; does nothing at all if not, then and later.
    // warnings: gets what was said; must stay for as long as the object lives.
    LiveView(const RenderOptions& options, const Film& film, std::vector<std::string>& warnings);
    // Gives the viewer some seconds for the rest of the picture.
    ~LiveView();
    LiveView(const LiveView&) = delete;
    LiveView& operator=(const LiveView&) = delete;

    // Takes over what the film has in the tile. From any thread, but only while nobody changes these pixels. The
    // progress is cleared before a warning is said.
    void tile_done(const Film& film, const Tile& tile, Progress& progress);

private:
    using Clock = std::chrono::steady_clock;

    void serve();
    std::string send_news(std::unique_lock<std::mutex>& lock);
    Window band(size_t i) const;
    void say(const std::string& problem);

    std::string place_;  // of the viewer, for messages
    std::vector<std::string>& warnings_;
    DisplayServer server_;  // belongs to the thread, once that runs
    std::atomic<bool> is_on_{false};

    std::mutex mutex_;  // for all that follows
    std::condition_variable news_;
    Image image_;                // the newest state
    int32_t rows_ = 1;           // of a band
    std::vector<bool> news_in_;  // for each band: whether the viewer lacks something of it
    bool is_closing_ = false;
    Clock::time_point deadline_;  // once it is closing
    uint64_t updates_ = 0;        // that were sent
    std::string problem_;         // not said yet
    std::thread thread_;
};

}  // namespace lancer
