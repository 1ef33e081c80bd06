// How a session renders what it shows: reduced pictures first, then the plan and passes of the full one.
#include <algorithm>
#include <bit>
#include <cmath>
#include <exception>

#include "app/system_info.h"
#include "app/view/session.h"
#include "app/view/still.h"
#include "core/lanes/denormals.h"
#include "core/parallel.h"
#include "report/metrics/error_estimate.h"

namespace lancer {
namespace {

constexpr uint32_t tile_side = 16;
constexpr double slow_preview = 0.05, fast_preview = 0.01;  // seconds

// Passes grow up to a block. Pixels that end by themselves have to see whole blocks.
uint32_t end_of_pass(uint32_t done, const RenderSettings& s)
{
    const uint32_t step = s.stop || done >= samples_per_block ? samples_per_block : std::max(1u, done);
    return std::min(done + step, s.spp);
}

// It takes seconds: not before it shows something, then whenever the samples have doubled, and at the end.
constexpr uint32_t least_denoised = 8;
bool is_worth_denoising(uint32_t samples, uint32_t spp)
{
    return samples >= spp || (samples >= least_denoised && std::has_single_bit(samples));
}

}  // namespace

void Session::advance_in_turn()
{
    const uint32_t before = samples_;
    const double begin = wall_seconds();
    advance();
    seconds_ += wall_seconds() - begin;
    if (samples_ == before || film_->replicates.empty()) return;
    const auto error = estimate_from_replicates(*film_, now_.settings.replicates);
    if (!error) return;
    const std::lock_guard lock(mutex_);
    status_.course.push_back({seconds_, std::sqrt(error->rel_mse), samples_});
}

void Session::advance()
{
    if (!has_more()) return;
    if (owes_picture_)
        show_whole(begin_step(true));
    else if (reduction_ > 1)
        preview();
    else
        add_samples();
}

// What is stopped is owed.
void Session::show_whole(const std::stop_token& stop)
{
    owes_picture_ = false;
    if (shows_light() || (now_.shown == ShownAs::denoised && !is_worth_denoising(samples_, now_.settings.spp))) return;
    const auto image = shown_image(*film_, now_.shown, renderer_->scene().normalisation, now_.settings.spp, stop);
    if (image) store_.put(*image, now_number_);
    owes_picture_ = !image;
}

bool Session::shows_light() const
{
    const bool is_first = samples_ < std::min(least_denoised, now_.settings.spp);
    return now_.shown == ShownAs::light || (now_.shown == ShownAs::denoised && is_first);
}

Film& Session::empty_film(uint32_t reduction)
{
    std::unique_ptr<Film>& film = films_[static_cast<size_t>(std::countr_zero(reduction))];
    if (film) {
        clear(*film);
        return *film;
    }
    film = std::make_unique<Film>(film_of(now_, reduction));
    // Its passes may end after any sample.
    if (reduction == 1 && !now_.settings.stop) film->keep_blocks_open();
    return *film;
}

// One sample of each pixel of a smaller picture.
void Session::preview()
{
    const bool is_coarsest = reduction_ == coarsest_;
    const std::stop_token stop = begin_step(!is_coarsest);
    const double begin = wall_seconds();
    Film& film = empty_film(reduction_);
    const Camera camera = camera_of(*renderer_, now_, film);
    const auto tiles = make_tiles(film.crop, tile_side);
    if (!renderer_->preview(camera, film, tiles, {0, 1}, stop).is_complete()) return;
    const double seconds = wall_seconds() - begin;
    store_.put(*shown_image(film, now_.shown, renderer_->scene().normalisation, now_.settings.spp, {}), now_number_);
    {
        const std::lock_guard lock(mutex_);
        status_.sight = now_number_, status_.reduction = reduction_;
    }
    reduction_ /= 2;
    if (!is_coarsest) return;
    if (seconds > slow_preview) coarsest_ = std::min(coarsest_ * 2, 16u);
    if (seconds < fast_preview) coarsest_ = 8;
}

// The renderer keeps it until another camera is asked for. False if the step is stopped first.
bool Session::make_plan(const Camera& camera, const std::stop_token& stop)
{
    std::unique_lock lock(mutex_);
    // One that was left alone ends first: two at once would both be slow.
    wake_.wait(lock, [&] { return !is_planning_ || stop.stop_requested(); });
    if (is_planning_) return false;
    if (planner_.joinable()) planner_.join();
    plan_ = std::stop_source();
    is_planning_ = true;
    planner_ = std::thread([this, camera, size = now_.settings.size, renderer = renderer_, token = plan_.get_token()] {
        set_flush_denormals();
        try {
            with_threads(threads_, [&] { renderer->plan(camera, size.width, size.height, token); });
        } catch (const std::exception&) {  // the pass will ask for it again, and tell
        }
        {
            const std::lock_guard end(mutex_);
            is_planning_ = false;
        }
        wake_.notify_all();
    });
    wake_.wait(lock, [&] { return !is_planning_ || stop.stop_requested(); });
    if (is_planning_) plan_.request_stop();
    return !is_planning_;
}

void Session::add_samples()
{
    const std::stop_token stop = begin_step(true);
    if (!film_) {
        film_ = &empty_film(1);
        store_.enlarge(film_->width, film_->height, now_number_);
    }
    const Camera camera = camera_of(*renderer_, now_, *film_);
    if (!has_plan_ && !make_plan(camera, stop)) return;
    has_plan_ = true;
    if (left_.empty()) {
        range_ = {range_.end, end_of_pass(range_.end, now_.settings)};
        left_ = make_tiles(film_->crop, tile_side);
    }
    const auto tile_done = [&](const Tile& tile) {
        if (shows_light()) store_.put_tile(*film_, tile);
    };
    left_ = renderer_->pass(camera, *film_, left_, range_, stop, tile_done).left;
    if (!left_.empty()) return;
    samples_ = range_.end;
    show_whole(stop);
    const std::lock_guard lock(mutex_);
    status_.sight = now_number_, status_.reduction = 1, status_.samples = samples_;
    status_.is_complete = samples_ >= now_.settings.spp;
}

}  // namespace lancer
