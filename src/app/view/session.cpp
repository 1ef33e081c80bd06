#include "app/view/session.h"

#include <exception>

#include "app/view/camera_moves.h"
#include "app/view/still.h"
#include "core/lanes/denormals.h"
#include "core/parallel.h"

namespace lancer {
namespace {

bool has_the_same_film(const Sight& a, const Sight& b)
{
    return a.settings.size == b.settings.size && a.settings.stop == b.settings.stop &&
           a.settings.replicates == b.settings.replicates && a.shown == b.shown;
}

}  // namespace

Session::Session(SessionSetup setup, Sight first)
    : rebuild_(std::move(setup.rebuild)),
      threads_(setup.threads),
      store_(std::move(setup.on_news)),
      now_(std::move(first)),
      now_number_(1),
      renderer_(std::move(setup.renderer)),
      turns_(std::move(setup.turns))
{
    status_.scenes_built = status_.accelerators_built = 1;
    thread_ = std::thread([this] { work(); });
}

Session::~Session()
{
    {
        const std::lock_guard lock(mutex_);
        is_closing_ = true;
        step_.request_stop(), still_.request_stop(), closing_.request_stop();
    }
    wake_.notify_all();
    thread_.join();
    plan_.request_stop();
    if (planner_.joinable()) planner_.join();
}

uint64_t Session::show(Sight sight)
{
    uint64_t number = 0;
    {
        const std::lock_guard lock(mutex_);
        wanted_ = std::move(sight);
        number = ++wanted_number_;
        if (can_be_cut_) step_.request_stop();
    }
    wake_.notify_all();
    return number;
}

void Session::pause(bool is_paused)
{
    {
        const std::lock_guard lock(mutex_);
        is_paused_ = is_paused;
    }
    wake_.notify_all();
}

SessionStatus Session::status() const
{
    const std::lock_guard lock(mutex_);
    return status_;
}

std::shared_ptr<const Renderer> Session::renderer() const
{
    const std::lock_guard lock(mutex_);
    return renderer_;
}

void Session::write_picture(Write write)
{
    {
        const std::lock_guard lock(mutex_);
        writes_.push_back(std::move(write));
    }
    wake_.notify_all();
}

void Session::render_still(Sight sight, uint32_t reduction, Write write)
{
    {
        const std::lock_guard lock(mutex_);
        stills_.push_back({std::move(sight), reduction, std::move(write)});
        if (can_be_cut_) step_.request_stop();
    }
    wake_.notify_all();
}

void Session::cancel_still()
{
    const std::lock_guard lock(mutex_);
    stills_.clear();
    still_.request_stop();
}

std::unique_ptr<Session> Session::beside(Sight sight)
{
    std::unique_ptr<Session> other;
    {
        const std::lock_guard lock(mutex_);
        if (!turns_) turns_ = std::make_shared<Turns>();
        other = std::make_unique<Session>(SessionSetup{.renderer = renderer_,
                                                       .rebuild = rebuild_,
                                                       .threads = threads_,
                                                       .on_news = store_.on_news(),
                                                       .turns = turns_},
                                          now_);
        other->pause(is_paused_);
    }
    other->show(std::move(sight));
    return other;
}

void Session::wait_until_idle() const
{
    std::unique_lock lock(mutex_);
    rest_.wait(lock, [&] { return is_idle_ && !wanted_ && stills_.empty() && (writes_.empty() || is_paused_); });
}

void Session::work()
{
    set_flush_denormals();  // as every thread that renders
    try {
        with_threads(threads_, [&] {
            while (wait_for_work()) step();
        });
    } catch (const std::exception& problem) {  // no threads to be had
        fail(problem.what());
    }
}

bool Session::wait_for_work()
{
    std::unique_lock lock(mutex_);
    const auto has_work = [&] {
        return is_closing_ || wanted_ || !stills_.empty() ||
               (!writes_.empty() && !has_failed_ && samples_ > 0 && left_.empty()) ||
               (!has_failed_ && has_more() && (!is_paused_ || reduction_ > 1));
    };
    is_idle_ = !has_work();
    if (is_idle_) rest_.notify_all();
    if (turns_ && (is_idle_ || is_closing_)) turns_->leave(this);
    wake_.wait(lock, has_work);
    is_idle_ = false;
    return !is_closing_;
}

void Session::step()
{
    Turns* turns = nullptr;
    {
        const std::lock_guard lock(mutex_);
        turns = turns_.get();
    }
    try {
        const Turns::Turn turn = turns ? turns->take(this, seconds_for_turn(), closing_.get_token()) : Turns::Turn();
        if (!adopt_wanted() && !run_job()) turns ? advance_in_turn() : advance();
    } catch (const std::exception& problem) {
        has_failed_ = true;
        fail(problem.what());
    }
}

void Session::fail(const std::string& problem)
{
    const std::lock_guard lock(mutex_);
    status_.problem = problem;
    is_idle_ = true;
    rest_.notify_all();
}

// What is new has had no time yet.
double Session::seconds_for_turn() const
{
    const std::lock_guard lock(mutex_);
    return wanted_ ? 0 : seconds_;
}

// Of what is done from here on until the next call.
std::stop_token Session::begin_step(bool can_be_cut)
{
    const std::lock_guard lock(mutex_);
    step_ = std::stop_source();
    can_be_cut_ = can_be_cut;
    if (is_closing_ || (can_be_cut && (wanted_ || !stills_.empty()))) step_.request_stop();
    return step_.get_token();
}

bool Session::adopt_wanted()
{
    std::optional<Sight> sight;
    {
        const std::lock_guard lock(mutex_);
        if (!wanted_) return false;
        sight = std::exchange(wanted_, {});
        now_number_ = wanted_number_;
        status_.problem = writes_.empty() ? "" : "the picture has changed before it could be written";
        writes_.clear();
    }
    adopt(std::move(*sight));
    return true;
}

void Session::adopt(Sight sight)
{
    has_failed_ = false;
    // More samples of the same go on where the picture is.
    const bool goes_on = film_ && is_same_view(sight.camera, now_.camera) && sight.scene == now_.scene &&
                         sight.shown == now_.shown && !sight.settings.stop && sight.settings.spp >= samples_ && [&] {
                             RenderSettings s = sight.settings;
                             s.spp = now_.settings.spp, s.given = now_.settings.given;
                             return s == now_.settings;
                         }();
    const bool keeps_films = has_the_same_film(sight, now_);
    make_ready_for(std::move(sight));
    if (!keeps_films) films_ = {};
    if (!goes_on) return restart();
    store_.keep_for(now_number_);
    const std::lock_guard lock(mutex_);
    status_.sight = now_number_, status_.is_complete = samples_ >= now_.settings.spp;
}

// With what the sight needs of the one before: nothing, a kernel, a scene, or its accelerator too.
void Session::make_ready_for(Sight sight)
{
    begin_step(false);
    const auto before = renderer();
    auto made = renderer_for(sight, now_, *before, rebuild_);
    const std::lock_guard lock(mutex_);
    now_ = std::move(sight);
    if (!made) return;
    status_.scenes_built += &made->scene() != &before->scene() ? 1 : 0;
    status_.accelerators_built += made->shares_accelerator_with(*before) ? 0 : 1;
    renderer_ = std::move(made);
}

void Session::restart()
{
    film_ = nullptr;
    left_.clear();
    range_ = {}, samples_ = 0, reduction_ = coarsest_, seconds_ = 0;
    has_plan_ = owes_picture_ = false;
    const std::lock_guard lock(mutex_);
    status_.samples = 0, status_.is_complete = false;
    status_.course.clear();
}

bool Session::run_job()
{
    std::optional<Still> still;
    Write write;
    {
        const std::lock_guard lock(mutex_);
        if (!stills_.empty()) {
            still = std::move(stills_.front());
            stills_.pop_front();
            still_ = std::stop_source();
            if (is_closing_) still_.request_stop();
        } else if (!writes_.empty() && samples_ > 0 && left_.empty()) {
            write = std::move(writes_.front());
            writes_.pop_front();
        }
    }
    try {
        if (still) run_still(*still);
        if (write) write(*film_, *renderer());
    } catch (const std::exception& problem) {  // the picture itself is none the worse
        fail(problem.what());
    }
    return still || write;
}

void Session::run_still(const Still& still)
{
    const auto report = [&](double done) {
        const std::lock_guard lock(mutex_);
        status_.still = done;
    };
    report(0);
    std::stop_token stop;
    {
        const std::lock_guard lock(mutex_);
        stop = still_.get_token();
    }
    try {
        const auto before = renderer();
        const auto other = renderer_for(still.sight, now_, *before, rebuild_);
        const Renderer& r = other ? *other : *before;
        const auto film = still_of(r, still.sight, still.reduction, stop, report);
        if (film) still.write(*film, r);
        has_plan_ = false;
    } catch (...) {
        report(-1);
        throw;
    }
    report(-1);
}

}  // namespace lancer
