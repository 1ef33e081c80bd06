// A scene that is rendered again and again while its camera, lights and materials change. It knows no window: whoever
// shows the picture says what it is to be of, and takes what there is of it. All rendering, and the rebuilding of what
// a change needs, is done on a thread of its own and those it starts: no member waits for it but the destructor.
#pragma once

#include <array>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "app/view/picture_store.h"
#include "app/view/rebuild.h"
#include "app/view/turns.h"
#include "render/renderer.h"

namespace lancer {

// What a session was made of and runs with.
struct SessionSetup {
    std::shared_ptr<const Renderer> renderer;  // of the first sight, with its accelerator
    RebuildSetup rebuild;                      // of scenes that change; its images must outlive the session
    unsigned threads = 1;
    std::function<void()> on_news = {};  // from any thread: there is something to take
    std::shared_ptr<Turns> turns = {};   // with whom it renders in turn; null: nobody
};

// The relative error of a picture, from its replicates, and the seconds of rendering until then.
struct ErrorAtTime {
    double seconds = 0, error = 0;
    uint32_t samples = 0;
};

struct SessionStatus {
    uint64_t sight = 0;      // that the picture is of
    uint32_t reduction = 0;  // the picture shown has 1/reduction of the width; 0: there is none
    uint32_t samples = 0;    // that every pixel of the full picture has
    bool is_complete = false;
    uint32_t scenes_built = 0, accelerators_built = 0;  // since the begin
    double still = -1;                                  // part of a still that is rendered; < 0: there is none
    std::string problem;                                // of the last sight or job; empty: none
    std::vector<ErrorAtTime> course;  // of the sight, if it has replicates and renders in turn with others
};

class Session {
public:
    Session(SessionSetup setup, Sight first);
    // Ends within milliseconds, but for a scene that is being built.
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    // Shows this from now on: at once in 1/8 of the resolution or less, then in steps up to the full one, where samples
    // add up. A first reduced picture is finished whatever comes, so that there are new ones while the camera moves;
    // all else is given up within a tile. Returns the number of this sight.
    uint64_t show(Sight sight);
    void pause(bool is_paused);

    bool take(ShownPicture& mine) { return store_.take(mine); }
    SessionStatus status() const;
    // The present one: for rays of one's own.
    std::shared_ptr<const Renderer> renderer() const;

    using Write = std::function<void(const Film&, const Renderer&)>;
    // Calls `write` on the session's thread with the full picture, as soon as all its pixels have equally many samples;
    // these have the bits of lancer render. Dropped, with a problem, if another sight comes first.
    void write_picture(Write write);
    // Renders a picture of 1/reduction of the width and height with all samples, before anything else goes on.
    void render_still(Sight sight, uint32_t reduction, Write write);
    void cancel_still();

    // Another session that shows `sight`, a change of what this one shows. From now on the two render in turn, and the
    // one goes next that had less time for its sight.
    std::unique_ptr<Session> beside(Sight sight);

    // Waits until the picture is complete or nothing more will come. For tests and for measuring.
    void wait_until_idle() const;

private:
    struct Still {
        Sight sight;
        uint32_t reduction;
        Write write;
    };

    void work();
    bool wait_for_work();
    void step();
    bool adopt_wanted();
    void adopt(Sight sight);
    void make_ready_for(Sight sight);
    void restart();
    bool run_job();
    void run_still(const Still& still);
    void advance();
    void advance_in_turn();
    double seconds_for_turn() const;
    void preview();
    void add_samples();
    Film& empty_film(uint32_t reduction);
    // Whether tiles are shown as they come: also what will be denoised, until it first is.
    bool shows_light() const;
    void show_whole(const std::stop_token& stop);
    bool make_plan(const Camera& camera, const std::stop_token& stop);
    void publish_whole(const Film& film);
    bool has_more() const { return reduction_ > 1 || samples_ < now_.settings.spp || !left_.empty() || owes_picture_; }
    std::stop_token begin_step(bool can_be_cut);
    void fail(const std::string& problem);

    const RebuildSetup rebuild_;
    const unsigned threads_;
    PictureStore store_;

    // Of the session's thread alone, but for now_, which others read with the mutex held.
    Sight now_;
    uint64_t now_number_ = 0;
    uint32_t coarsest_ = 8, reduction_ = 8;
    // Of each reduction, as its logarithm. They are used again: memory from the system costs more than a preview.
    std::array<std::unique_ptr<Film>, 5> films_;
    Film* film_ = nullptr;    // of the full picture; null: it has no samples yet
    std::vector<Tile> left_;  // of the pass that was cut
    SampleRange range_;
    uint32_t samples_ = 0;
    bool has_plan_ = false, has_failed_ = false, owes_picture_ = false;
    double seconds_ = 0;  // of rendering since the restart

    mutable std::mutex mutex_;  // guards what follows
    mutable std::condition_variable wake_, rest_;
    std::shared_ptr<const Renderer> renderer_;
    std::optional<Sight> wanted_;
    uint64_t wanted_number_ = 1;
    std::deque<Still> stills_;
    std::deque<Write> writes_;
    std::stop_source step_, still_, closing_;
    std::shared_ptr<Turns> turns_;
    bool can_be_cut_ = false, is_paused_ = false, is_closing_ = false, is_idle_ = false;
    SessionStatus status_;
    bool is_planning_ = false;

    // A plan takes longer than the hand may wait: it is made beside the session's thread, which may leave it alone.
    std::stop_source plan_;
    std::thread planner_;
    std::thread thread_;  // the last member: it uses all others
};

}  // namespace lancer
