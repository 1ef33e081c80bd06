// lancer film: the frames of an [animation] or a turntable, by one process that keeps what does not change.
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/commands.h"
#include "app/console.h"
#include "app/film/movie.h"
#include "app/frame_cache.h"
#include "app/options/options.h"
#include "app/paths.h"
#include "app/render/frames.h"
#include "app/render/render_frame.h"
#include "app/signals.h"
#include "app/system_info.h"
#include "io/scene/scene_file.h"

namespace lancer {
namespace {

// A picture that only the movie needs.
class ScratchPicture {
public:
    ScratchPicture()
        : path_(std::filesystem::temp_directory_path() / ("lancer-film." + std::to_string(getpid()) + ".png"))
    {
    }
    ~ScratchPicture()
    {
        std::error_code absent;
        std::filesystem::remove(path_, absent);
    }
    ScratchPicture(const ScratchPicture&) = delete;
    ScratchPicture& operator=(const ScratchPicture&) = delete;
    const std::string& path() const { return path_; }

private:
    std::string path_;
};

class FilmRun {
public:
    explicit FilmRun(const FilmOptions& options) : options_(options) { cache_.skips_finished = !options.again; }

    int execute()
    {
        const std::vector<uint32_t> frames = choose_frames();
        if (!options_.movie.empty()) movie_.emplace(options_.movie, options_.fps.value_or(fps_));
        size_t drawn = 0, done = 0;
        for (const uint32_t frame : frames) {
            const double begin = wall_seconds();
            const FrameEnd end = signals_.interrupted() ? FrameEnd{exit_interrupted} : draw(frame, drawn > 0);
            if (end.code == exit_interrupted || end.code == exit_unfinished) return stop(frames.size() - done);
            if (end.code != exit_done) return end.code;
            ++done;
            if (end.was_there) continue;
            ++drawn;
            tell(format_text("frame %u: %zu of %zu, %.2f s", frame, done, frames.size(), wall_seconds() - begin));
        }
        if (movie_) {
            movie_->finish();
            if (done > 0) print_path(options_.movie);
        }
        tell(format_text("%zu frames drawn, %zu were there", drawn, done - drawn));
        return exit_done;
    }

private:
    void tell(const std::string& line) const
    {
        if (!options_.render.quiet) print_note(line);
    }

    // Those of this shard.
    std::vector<uint32_t> choose_frames()
    {
        const SceneChoice& scene = options_.render.picture.scene;
        FrameRange all{0, scene.turntable - 1};
        if (scene.turntable == 0) {
            Diagnostics diagnostics;
            const auto animation = read_animation(scene.file, scene.definitions, diagnostics);
            diagnostics.throw_if_errors();
            if (!animation)
                throw Error(ErrorKind::usage, {},
                            "the scene has no [animation]; --turntable N turns the camera around it");
            all = {animation->first, animation->last};
            fps_ = animation->fps;
        }
        const FrameRange asked = options_.render.frames.value_or(all);
        if (asked.first < all.first || asked.last > all.last)
            throw Error(ErrorKind::usage, {},
                        format_text("--frames: the film has the frames %u to %u", all.first, all.last));
        const Shard& shard = options_.shard;
        std::vector<uint32_t> own;
        for (uint32_t frame = asked.first; frame <= asked.last; ++frame)
            if (shard.is_whole() || (frame - asked.first) % shard.count == shard.index - 1) own.push_back(frame);
        return own;
    }

    FrameEnd draw(uint32_t frame, bool is_known)
    {
        const ScratchPicture scratch;
        RenderOptions one = options_of_frame(options_.render, frame);
        one.picture.scene.file = options_.render.picture.scene.file;
        one.picture.scene.frame = frame;
        if (is_known && !one.verbose) one.quiet = true;  // what is said of the scene is said once
        std::string of_movie;
        if (movie_) {
            const auto png = std::find_if(one.outputs.begin(), one.outputs.end(),
                                          [](const std::string& name) { return extension_of(name) == ".png"; });
            of_movie = png == one.outputs.end() ? scratch.path() : *png;
            if (png == one.outputs.end()) one.outputs.push_back(of_movie);
        }
        const FrameEnd end = render_frame(one, signals_, &cache_);
        if (movie_ && end.code == exit_done) movie_->add(of_movie);
        return end;
    }

    int stop(size_t left) const
    {
        const bool goes_on = !options_.render.outputs.empty();
        print_problem(format_text("warning: interrupted: %zu frames are left%s", left,
                                  goes_on ? "; the same command goes on" : "; there is no film"));
        return goes_on ? exit_unfinished : exit_interrupted;
    }

    const FilmOptions& options_;
    Signals signals_;
    FrameCache cache_;
    std::optional<Movie> movie_;
    double fps_ = 24;
};

}  // namespace

int run_film(int argc, char** argv)
{
    const auto options = parse_film(argc, argv);
    return options ? FilmRun(*options).execute() : exit_done;
}

}  // namespace lancer
