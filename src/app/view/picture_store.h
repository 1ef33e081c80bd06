// The picture on its way from the threads that render to the window that shows it.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

#include "core/film.h"
#include "core/image.h"

namespace lancer {

// What the window has of it. Linear radiance, or what else is shown in its place.
struct ShownPicture {
    Image image = make_image(0, 0);  // of a reduced pass: smaller than the picture
    uint64_t version = 0;            // grows with every change; 0: there is none yet
    uint64_t sight = 0;              // of which sight it is; see Session::show()
    // Half-open range of rows that the last take() changed.
    int32_t first_row = 0, end_row = 0;
};

// Columns [first, end) of `to` become those of `from` as if it had the size of `to`: each pixel is the one that lies
// there. Nothing if `from` has no pixels.
void enlarge_columns(const Image& from, int32_t first, int32_t end, Image& to);

// All members may be called from any thread.
class PictureStore {
public:
    // on_news: called without a lock after a whole picture, and now and then while tiles come.
    explicit PictureStore(std::function<void()> on_news) : on_news_(std::move(on_news)) {}
    const std::function<void()>& on_news() const { return on_news_; }

    void put(const Image& image, uint64_t sight);
    // A picture of this size that shows what is there, enlarged, until put_tile() brings its pixels.
    void enlarge(uint32_t width, uint32_t height, uint64_t sight);
    // The means of the tile's pixels. The film must not change them meanwhile; it has the size of the last picture.
    void put_tile(const Film& film, const Tile& tile);
    // What is there is of this sight, too.
    void keep_for(uint64_t sight);
    // Brings `mine` up to date; false if it is.
    bool take(ShownPicture& mine);

private:
    static constexpr int32_t band = 16;  // rows whose changes are known together

    using Clock = std::chrono::steady_clock;
    // Between pictures of one that only gets better: nobody sees more, and each costs time to draw.
    static constexpr auto pause_of_tiles = std::chrono::milliseconds(100);

    const std::function<void()> on_news_;
    std::mutex mutex_;
    Image image_ = make_image(0, 0);
    uint64_t version_ = 0, sight_ = 0;
    std::vector<uint64_t> changed_;  // of each band the version that changed it
    Clock::time_point told_{};
};

}  // namespace lancer
