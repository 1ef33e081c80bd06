#include "app/view/picture_store.h"

#include <algorithm>

namespace lancer {
namespace {

// Memory is kept: to get it from the system takes longer than a preview.
void set_size(Image& image, int32_t width, int32_t height)
{
    image.display = image.data = {0, 0, width, height};
    image.pixels.resize(image.data.area());
}

}  // namespace

void enlarge_columns(const Image& from, int32_t first, int32_t end, Image& to)
{
    const int64_t w = from.data.width(), h = from.data.height();
    if (w == 0 || h == 0) return;
    const int32_t width = to.data.width(), height = to.data.height();
    std::vector<int32_t> columns;
    for (int32_t x = first; x < end; ++x) columns.push_back(static_cast<int32_t>(x * w / width));
    for (int32_t y = 0; y < height; ++y) {
        const Color* const row = &from.at(0, static_cast<int32_t>(y * h / height));
        Color* pixel = &to.at(0, y) + first;
        for (const int32_t x : columns) *pixel++ = row[x];
    }
}

void PictureStore::put(const Image& image, uint64_t sight)
{
    {
        const std::lock_guard lock(mutex_);
        told_ = Clock::now();
        image_ = image, sight_ = sight;
        changed_.assign(static_cast<size_t>((image_.data.height() + band - 1) / band), ++version_);
    }
    if (on_news_) on_news_();
}

void PictureStore::enlarge(uint32_t width, uint32_t height, uint64_t sight)
{
    const std::lock_guard lock(mutex_);
    const Image small = image_;
    set_size(image_, static_cast<int32_t>(width), static_cast<int32_t>(height));
    sight_ = sight;
    enlarge_columns(small, 0, static_cast<int32_t>(width), image_);
    changed_.assign(static_cast<size_t>((image_.data.height() + band - 1) / band), ++version_);
}

void PictureStore::put_tile(const Film& film, const Tile& tile)
{
    bool is_due = false;
    {
        const std::lock_guard lock(mutex_);
        const auto now = Clock::now();
        is_due = now - told_ >= pause_of_tiles;
        if (is_due) told_ = now;
        ++version_;
        for (uint32_t y = tile.y0; y < tile.y1; ++y) {
            for (uint32_t x = tile.x0; x < tile.x1; ++x)
                image_.at(static_cast<int32_t>(x), static_cast<int32_t>(y)) = film.whole(film.index(x, y)).mean();
            changed_[static_cast<size_t>(static_cast<int32_t>(y) / band)] = version_;
        }
    }
    if (is_due && on_news_) on_news_();
}

void PictureStore::keep_for(uint64_t sight)
{
    {
        const std::lock_guard lock(mutex_);
        sight_ = sight, ++version_;
    }
    if (on_news_) on_news_();
}

bool PictureStore::take(ShownPicture& mine)
{
    const std::lock_guard lock(mutex_);
    if (mine.version == version_) return false;
    const int32_t rows = image_.data.height();
    const bool is_other = mine.image.data != image_.data;
    if (is_other) set_size(mine.image, image_.data.width(), rows);
    mine.first_row = rows, mine.end_row = 0;
    const auto width = static_cast<std::ptrdiff_t>(image_.data.width());
    for (size_t i = 0; i < changed_.size(); ++i) {
        if (!is_other && changed_[i] <= mine.version) continue;
        const int32_t first = static_cast<int32_t>(i) * band, end = std::min(first + band, rows);
        std::copy(image_.pixels.begin() + first * width, image_.pixels.begin() + end * width,
                  mine.image.pixels.begin() + first * width);
        mine.first_row = std::min(mine.first_row, first), mine.end_row = std::max(mine.end_row, end);
    }
    mine.version = version_, mine.sight = sight_;
    return true;
}

}  // namespace lancer
