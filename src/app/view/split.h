// Two settings of one view beside each other, with the error of each against the time that it took.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/view/session.h"
#include "app/view/window_types.h"

namespace lancer {

class Split {
public:
    // right: what is shown goes on, on the right of a line; `kept` is shown on its left. Both restart.
    Split(Session& right, const Sight& kept);

    // From now on this on the right; on the left the same with the settings that were kept. Returns the number of the
    // right one.
    uint64_t show(const Sight& sight);
    void pause(bool is_paused) { left_->pause(is_paused); }

    // As Session::take(): both in one picture.
    bool take(ShownPicture& both);
    // Where the line is, as a part of the width.
    double place() const { return place_; }
    void move_to(double place);

    // What differs, and how far each is.
    std::vector<std::string> lines() const;
    // The line, and the errors against time, over a picture of this size.
    std::vector<Mark> marks(PictureSize size) const;

    // Waits until both are complete. For tests.
    void wait_until_idle() const;

private:
    Session& right_;
    std::unique_ptr<Session> left_;
    RenderSettings kept_, now_;
    ShownPicture left_picture_, right_picture_;
    double place_ = 0.5;
    bool has_moved_ = true;
};

}  // namespace lancer
