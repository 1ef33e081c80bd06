#include "io/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "core/error.h"

namespace lancer {
namespace {

std::string folder_of(const std::string& path)
{
    const size_t slash = path.rfind('/');
    if (slash == std::string::npos) return ".";
    return slash == 0 ? "/" : path.substr(0, slash);
}

// The path with symbolic links followed, or as given where that fails (a dangling link is then replaced).
std::string follow_links(const std::string& path)
{
    char* const resolved = realpath(path.c_str(), nullptr);
    if (!resolved) return path;
    const std::string result = resolved;
    std::free(resolved);
    return result;
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path, Temporary temporary) : path_(path), target_(path)
{
    if (path.empty()) throw Error(ErrorKind::failed, "error: cannot write to an empty file name");
    struct stat old = {};
    const bool exists = stat(path.c_str(), &old) == 0;
    if (!exists && errno != ENOENT) fail(errno);
    if ((exists && S_ISDIR(old.st_mode)) || path.back() == '/') fail(EISDIR);
    if (exists && S_ISFIFO(old.st_mode)) {
        if (access(path.c_str(), W_OK) != 0) fail(errno);
        is_pipe_ = true;
        file_ = std::tmpfile();
        if (!file_) fail(errno);
        return;
    }
    if (exists && !S_ISREG(old.st_mode)) {
        const int descriptor = open(path.c_str(), O_WRONLY | O_CLOEXEC);
        if (descriptor < 0) fail(errno);
        attach(descriptor);
        return;
    }
    if (exists) {
        if (access(path.c_str(), W_OK) != 0) fail(errno);  // renaming over it would get around its protection
        target_ = follow_links(path);
    }
    if (temporary == Temporary::named || !open_unnamed()) open_temporary();
    if (exists) fchmod(fileno(file_), old.st_mode & 07777);  // the new file is open to the same readers
}

AtomicFile::~AtomicFile()
{
    if (file_) std::fclose(file_);
    if (!temporary_.empty()) unlink(temporary_.c_str());
}

// Returns whether there is such a thing here; the reason why not is found again by open_temporary().
bool AtomicFile::open_unnamed()
{
    if (access("/proc/self/fd", X_OK) != 0) return false;  // by which it gets its name
    const int descriptor = open(folder_of(target_).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor < 0) return false;
    attach(descriptor);
    is_unnamed_ = true;
    return true;
}

// A process killed long ago may have left a file with our number: such a name is passed over, not overwritten.
template <class Take>
void AtomicFile::find_free_name(const Take& take)
{
    const std::string base = target_ + ".tmp." + std::to_string(getpid());
    for (int i = 0; i < 100; ++i) {
        const std::string name = i == 0 ? base : base + "." + std::to_string(i);
        const int reason = take(name);
        if (reason == EEXIST) continue;
        if (reason != 0) fail(reason);
        temporary_ = name;
        return;
    }
    fail(EEXIST);
}

void AtomicFile::open_temporary()
{
    find_free_name([&](const std::string& name) {
        const int descriptor = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor < 0) return errno;
        attach(descriptor);
        return 0;
    });
}

void AtomicFile::attach(int descriptor)
{
    file_ = fdopen(descriptor, "wb");
    if (file_) return;
    const int reason = errno;
    close(descriptor);
    fail(reason);
}

void AtomicFile::fail(int reason)
{
    if (!reason_) reason_ = reason;
    std::string message = std::string("cannot write: ") + std::strerror(reason_);
    if (reason_ == ENOSPC || reason_ == EDQUOT || reason_ == EFBIG) {
        message += "; free some space or write to another folder";
    } else if (reason_ == ENOENT || reason_ == ENOTDIR || reason_ == EACCES || reason_ == EROFS) {
        message += " (folder " + folder_of(target_) + ")";
    }
    throw Error(ErrorKind::failed, {path_}, message);
}

void AtomicFile::write(const void* bytes, size_t count)
{
    if (reason_) fail(reason_);
    if (std::fwrite(bytes, 1, count, file_) != count) fail(errno);
}

void AtomicFile::seek(uint64_t position)
{
    if (reason_) fail(reason_);
    if (fseeko(file_, static_cast<off_t>(position), SEEK_SET) != 0) fail(errno);
}

uint64_t AtomicFile::tell()
{
    const off_t position = ftello(file_);
    if (position < 0) fail(errno);
    return static_cast<uint64_t>(position);
}

void AtomicFile::finish()
{
    if (reason_) fail(reason_);
    if (!file_) return;
    if (std::fflush(file_) != 0) fail(errno);
    if (temporary_.empty() && !is_unnamed_) return;
    if (fsync(fileno(file_)) != 0) fail(errno);
    if (!is_unnamed_) close_file();  // else it would be gone
}

void AtomicFile::close_file()
{
    std::FILE* const closing = file_;
    file_ = nullptr;
    if (std::fclose(closing) != 0) fail(errno);
}

void AtomicFile::commit()
{
    finish();
    if (is_pipe_) return send_to_pipe();
    // A file without a name cannot take that of another: it gets one of its own for a moment.
    if (is_unnamed_) {
        const std::string own = "/proc/self/fd/" + std::to_string(fileno(file_));
        find_free_name([&](const std::string& name) {
            return linkat(AT_FDCWD, own.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0 ? 0 : errno;
        });
        is_unnamed_ = false;
        close_file();
    }
    if (temporary_.empty()) return;
    if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
    temporary_.clear();
    sync_folder();
}

void AtomicFile::send_to_pipe()
{
    std::rewind(file_);
    const int pipe = open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (pipe < 0) fail(errno);
    std::array<char, 1 << 16> bytes;
    int reason = 0;
    for (size_t count; !reason && (count = std::fread(bytes.data(), 1, bytes.size(), file_)) > 0;)
        for (size_t sent = 0; !reason && sent < count;) {
            const ssize_t n = ::write(pipe, &bytes[sent], count - sent);
            if (n >= 0)
                sent += static_cast<size_t>(n);
            else if (errno != EINTR)
                reason = errno;
        }
    close(pipe);
    if (reason) fail(reason);
}

// Makes the new name survive a power cut. The file is in place already, so a folder that may not be opened or a file
// system that cannot do this is no failure.
void AtomicFile::sync_folder() const
{
    const int descriptor = open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    fsync(descriptor);
    close(descriptor);
}

void write_text(const std::string& path, const std::string& text)
{
    AtomicFile file(path);
    file.write(text.data(), text.size());
    file.commit();
}

}  // namespace lancer
