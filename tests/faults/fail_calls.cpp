// A library for LD_PRELOAD that makes calls fail by which a program writes files: those of regular files below the
// folder LANCER_FAIL_BELOW, counted from 1. The call LANCER_FAIL_CALL fails with the error number LANCER_FAIL_ERRNO,
// and all after it where LANCER_FAIL_LASTING is set. Their number is written to the file LANCER_FAIL_COUNT at the end.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

std::atomic<int> calls{0};

std::string variable(const char* name)
{
    const char* const value = std::getenv(name);
    return value ? value : "";
}
int number(const char* name) { return std::atoi(variable(name).c_str()); }

bool is_below(const std::string& path)
{
    static const std::string folder = variable("LANCER_FAIL_BELOW");
    return !folder.empty() && path.find(folder) != std::string::npos;
}

// The path of an open regular file; of one without a name, where it lies.
bool is_below(int descriptor)
{
    struct stat facts = {};
    if (descriptor < 0 || fstat(descriptor, &facts) != 0 || !S_ISREG(facts.st_mode)) return false;
    char path[4096];
    const ssize_t length = readlink(("/proc/self/fd/" + std::to_string(descriptor)).c_str(), path, sizeof path);
    return length > 0 && is_below(std::string(path, static_cast<size_t>(length)));
}

bool fails()
{
    static const int at = number("LANCER_FAIL_CALL"), reason = number("LANCER_FAIL_ERRNO");
    static const bool is_lasting = !variable("LANCER_FAIL_LASTING").empty();
    const int call = ++calls;
    if (at == 0 || call < at || (call > at && !is_lasting)) return false;
    errno = reason;
    return true;
}

struct AtExit {
    ~AtExit()
    {
        const std::string file = variable("LANCER_FAIL_COUNT");
        if (file.empty()) return;
        const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
        const std::string text = std::to_string(calls.load());
        [[maybe_unused]] const ssize_t written = write(descriptor, text.data(), text.size());
        close(descriptor);
    }
} at_exit;

template <class F>
F* next(const char* name)
{
    return reinterpret_cast<F*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...)
{
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = va_arg(rest, mode_t);
    va_end(rest);
    if ((flags & (O_WRONLY | O_RDWR)) != 0 && is_below(path) && fails()) return -1;
    static auto* const real = next<int(const char*, int, ...)>("open");
    return real(path, flags, mode);
}
size_t fwrite(const void* bytes, size_t size, size_t count, FILE* file)
{
    if (is_below(fileno(file)) && fails()) return 0;
    static auto* const real = next<size_t(const void*, size_t, size_t, FILE*)>("fwrite");
    return real(bytes, size, count, file);
}
int fflush(FILE* file)
{
    if (file && is_below(fileno(file)) && fails()) return EOF;
    static auto* const real = next<int(FILE*)>("fflush");
    return real(file);
}
int fseeko(FILE* file, off_t offset, int whence)
{
    if (is_below(fileno(file)) && fails()) return -1;
    static auto* const real = next<int(FILE*, off_t, int)>("fseeko");
    return real(file, offset, whence);
}
int fclose(FILE* file)
{
    const bool has_failed = is_below(fileno(file)) && fails();
    const int reason = errno;
    static auto* const real = next<int(FILE*)>("fclose");
    const int result = real(file);
    if (!has_failed) return result;
    errno = reason;
    return EOF;
}
int fsync(int descriptor)
{
    if (is_below(descriptor) && fails()) return -1;
    static auto* const real = next<int(int)>("fsync");
    return real(descriptor);
}
int rename(const char* from, const char* to)
{
    if (is_below(to) && fails()) return -1;
    static auto* const real = next<int(const char*, const char*)>("rename");
    return real(from, to);
}
int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags)
{
    if (is_below(to) && fails()) return -1;
    static auto* const real = next<int(int, const char*, int, const char*, int)>("linkat");
    return real(from_folder, from, to_folder, to, flags);
}

}  // extern "C"
