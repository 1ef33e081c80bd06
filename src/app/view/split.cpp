#include "app/view/split.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/console.h"
#include "scene/description/render_options.h"

namespace lancer {
namespace {

// Their scatter gives the error of any sampler without a bias.
constexpr uint32_t replicates = 4;
constexpr uint32_t left_color = 0xff40c0ff, right_color = 0xffffc040, frame_color = 0xffa0a0a0,
                   shade_color = 0xc0000000, text_color = 0xffffffff;
constexpr double widest_chart = 240, highest_chart = 140, chart_margin = 12;
constexpr double part_of_chart = 0.4;  // of the picture, at most

// Of the view of a sight.
Sight in_replicates(const Sight& sight, const RenderSettings& settings)
{
    Sight by = sight;
    by.settings = settings;
    by.settings.replicates = std::max(settings.replicates, replicates);
    return by;
}

// Of what differs, the values of one.
std::string told(const RenderSettings& of, const RenderSettings& other)
{
    std::string text;
    for (const RenderOption& option : render_options())
        if (const std::string value = value_text(of, option); value != value_text(other, option))
            text += (text.empty() ? "" : ", ") + std::string(option.name) + " " + value;
    return text.empty() ? "the same" : text;
}

std::string progress_of(const SessionStatus& status)
{
    if (status.course.empty()) return "  no error yet";
    const ErrorAtTime& now = status.course.back();
    return format_text("  %u samples, %.1f s, error %.4f", now.samples, now.seconds, now.error);
}

// The squared error at that time, between its pictures as if both were logarithms. Nothing outside of them.
std::optional<double> square_at(const std::vector<ErrorAtTime>& course, double seconds)
{
    for (size_t i = 1; i < course.size(); ++i) {
        const ErrorAtTime &a = course[i - 1], &b = course[i];
        if (!(a.seconds <= seconds && seconds <= b.seconds && a.seconds < b.seconds && a.error > 0 && b.error > 0))
            continue;
        const double part = std::log(seconds / a.seconds) / std::log(b.seconds / a.seconds);
        return std::pow(a.error * std::pow(b.error / a.error, part), 2);
    }
    return {};
}

Mark line(double x0, double y0, double x1, double y1, uint32_t color)
{
    return {.kind = Mark::Kind::line, .x0 = x0, .y0 = y0, .x1 = x1, .y1 = y1, .color = color};
}

// Error against seconds, both as logarithms, from the lower left corner of the picture on.
void add_chart(const std::vector<ErrorAtTime>& left, const std::vector<ErrorAtTime>& right, PictureSize size,
               std::vector<Mark>& marks)
{
    const double chart_width = std::min(widest_chart, part_of_chart * size.width),
                 chart_height = std::min(highest_chart, part_of_chart * size.height);
    double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
    const auto across = [](const ErrorAtTime& at) { return std::log(at.seconds); };
    const auto up = [](const ErrorAtTime& at) { return std::log(at.error); };
    const auto counts = [](const ErrorAtTime& at) { return at.seconds > 0 && at.error > 0; };
    for (const auto* course : {&left, &right})
        for (const ErrorAtTime& at : *course)
            if (counts(at)) {
                x0 = std::min(x0, across(at)), x1 = std::max(x1, across(at));
                y0 = std::min(y0, up(at)), y1 = std::max(y1, up(at));
            }
    if (!(x1 > x0 && y1 > y0)) return;
    const double bottom = size.height - chart_margin, top = bottom - chart_height;
    marks.push_back(line(chart_margin, top, chart_margin, bottom, frame_color));
    marks.push_back(line(chart_margin, bottom, chart_margin + chart_width, bottom, frame_color));
    const auto place = [&](const ErrorAtTime& at) {
        return std::pair(chart_margin + (across(at) - x0) / (x1 - x0) * chart_width,
                         bottom - (up(at) - y0) / (y1 - y0) * chart_height);
    };
    const auto add = [&](const std::vector<ErrorAtTime>& course, uint32_t color) {
        for (size_t i = 1; i < course.size(); ++i) {
            if (!counts(course[i - 1]) || !counts(course[i])) continue;
            const auto [ax, ay] = place(course[i - 1]);
            const auto [bx, by] = place(course[i]);
            marks.push_back(line(ax, ay + 1, bx, by + 1, shade_color));
            marks.push_back(line(ax, ay, bx, by, color));
        }
    };
    add(left, left_color), add(right, right_color);
    const auto label = [&](double x, double y, const std::string& text) {
        for (const auto& [by, color] : {std::pair(1, shade_color), std::pair(0, text_color)})
            marks.push_back({.kind = Mark::Kind::text, .x0 = x + by, .y0 = y + by, .color = color, .text = text});
    };
    label(chart_margin + 4, top - 6, format_text("error %.3g", std::exp(y1)));
    label(chart_margin + chart_width - 50, bottom - 16, format_text("%.3g s", std::exp(x1)));
}

}  // namespace

Split::Split(Session& right, const Sight& kept)
    : right_(right), left_(right.beside(in_replicates(kept, kept.settings))), kept_(kept.settings), now_(kept.settings)
{
}

uint64_t Split::show(const Sight& sight)
{
    now_ = sight.settings;
    kept_.spp = now_.spp;
    left_->show(in_replicates(sight, kept_));
    return right_.show(in_replicates(sight, now_));
}

bool Split::take(ShownPicture& both)
{
    const bool left_is_new = left_->take(left_picture_), right_is_new = right_.take(right_picture_);
    if (!left_is_new && !right_is_new && !has_moved_) return false;
    has_moved_ = false;
    const Image& left = left_picture_.image;
    const Image& right = right_picture_.image;
    if (right.pixels.empty()) return false;
    const bool has_left = !left.pixels.empty();
    const Image& larger = has_left && left.pixels.size() > right.pixels.size() ? left : right;
    const int32_t width = larger.data.width(), height = larger.data.height();
    both.image.display = larger.data, both.image.data = larger.data;
    both.image.pixels.resize(larger.pixels.size());
    const int32_t line = has_left ? static_cast<int32_t>(std::lround(place_ * width)) : 0;
    enlarge_columns(left, 0, line, both.image);
    enlarge_columns(right, line, width, both.image);
    ++both.version;
    both.sight = right_picture_.sight;
    both.first_row = 0, both.end_row = height;
    return true;
}

void Split::move_to(double place) { place_ = std::clamp(place, 0.0, 1.0), has_moved_ = true; }

void Split::wait_until_idle() const { left_->wait_until_idle(), right_.wait_until_idle(); }

std::vector<std::string> Split::lines() const
{
    const SessionStatus left = left_->status(), right = right_.status();
    std::vector<std::string> lines{"left: " + told(kept_, now_), progress_of(left), "right: " + told(now_, kept_),
                                   progress_of(right)};
    if (!left.course.empty() && !right.course.empty()) {
        const double seconds = std::min(left.course.back().seconds, right.course.back().seconds);
        const auto of_left = square_at(left.course, seconds), of_right = square_at(right.course, seconds);
        if (of_left && of_right)
            lines.push_back(
                format_text("squared error after %.1f s, right / left: %.3g", seconds, *of_right / *of_left));
    }
    if (!left.problem.empty()) lines.push_back("left: " + left.problem);
    return lines;
}

std::vector<Mark> Split::marks(PictureSize size) const
{
    const double x = place_ * size.width;
    std::vector<Mark> marks{line(x, 0, x, size.height, frame_color)};
    add_chart(left_->status().course, right_.status().course, size, marks);
    return marks;
}

}  // namespace lancer
