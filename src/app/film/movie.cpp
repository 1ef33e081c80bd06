#include "app/film/movie.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <vector>

#include "app/console.h"
#include "core/error.h"
#include "io/input_text.h"

namespace lancer {
namespace {

bool is_installed(const std::string& program)
{
    const char* const path = std::getenv("PATH");
    std::string folders = path ? path : "/usr/bin:/bin";
    for (size_t at = 0; at <= folders.size();) {
        const size_t end = std::min(folders.find(':', at), folders.size());
        if (access((folders.substr(at, end - at) + "/" + program).c_str(), X_OK) == 0) return true;
        at = end + 1;
    }
    return false;
}

}  // namespace

Movie::Movie(std::string path, double fps)
    : path_(std::move(path)), temporary_(path_ + ".tmp." + std::to_string(getpid())), fps_(fps)
{
    if (!is_installed("ffmpeg"))
        throw Error(ErrorKind::failed, {path_},
                    "needs ffmpeg, which is not installed (apt-get install ffmpeg); -o NAME.####.png writes the frames "
                    "without it");
}

Movie::~Movie()
{
    if (child_ <= 0) return;
    kill(child_, SIGKILL);
    end();
    std::error_code absent;
    std::filesystem::remove(temporary_, absent);
}

void Movie::start()
{
    // Colours at half the resolution, which every player takes, need even sides.
    std::vector<std::string> words{"ffmpeg",     "-v",           "error",
                                   "-nostdin",   "-y",           "-f",
                                   "image2pipe", "-c:v",         "png",
                                   "-framerate", shortest(fps_), "-i",
                                   "pipe:0",     "-vf",          "pad=ceil(iw/2)*2:ceil(ih/2)*2,format=yuv420p",
                                   "-c:v",       "libx264",      "-crf",
                                   "16",         "-movflags",    "+faststart",
                                   "-f",         "mp4",          "file:" + temporary_};
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) fail();
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);  // an interrupt is for us
    const int problem = posix_spawnp(&child_, "ffmpeg", &actions, &attributes, pointers.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[0]);
    input_ = ends[1];
    if (problem != 0) {
        child_ = 0;
        throw Error(ErrorKind::failed, {path_}, std::string("ffmpeg cannot be started: ") + std::strerror(problem));
    }
}

void Movie::add(const std::string& picture)
{
    if (child_ <= 0) start();
    const std::string bytes = read_input_text(picture);
    for (size_t done = 0; done < bytes.size();) {
        const ssize_t n = write(input_, bytes.data() + done, bytes.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) fail();
        done += static_cast<size_t>(n);
    }
}

// Its exit code.
int Movie::end()
{
    if (input_ >= 0) close(input_);
    input_ = -1;
    int status = 0;
    while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
    child_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void Movie::finish()
{
    if (child_ <= 0) return;
    if (end() != 0 || std::rename(temporary_.c_str(), path_.c_str()) != 0) {
        std::error_code absent;
        std::filesystem::remove(temporary_, absent);
        fail();
    }
}

void Movie::fail() const { throw Error(ErrorKind::failed, {path_}, "ffmpeg could not write the film"); }

}  // namespace lancer
