// A film as one file: frames go to ffmpeg, another program, as it is installed.
#pragma once

#include <string>

#include <sys/types.h>

namespace lancer {

// Its first frame starts it. The file appears when finish() returns; without it there is none.
class Movie {
public:
    // path: ends in .mp4. fps: frames per second. Throws Error (failed) if there is no ffmpeg.
    Movie(std::string path, double fps);
    ~Movie();
    Movie(const Movie&) = delete;
    Movie& operator=(const Movie&) = delete;

    // The next frame, a PNG file, all of one size. Throws Error (failed) if ffmpeg does not take it.
    void add(const std::string& picture);
    // Throws Error (failed) if ffmpeg fails.
    void finish();

private:
    void start();
    int end();
    [[noreturn]] void fail() const;

    std::string path_, temporary_;
    double fps_;
    int input_ = -1;  // of ffmpeg
    pid_t child_ = 0;
};

}  // namespace lancer
