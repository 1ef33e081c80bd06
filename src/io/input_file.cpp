#include "io/input_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>

#include "io/file_part.h"

namespace lancer {
namespace {

// A file in memory alone, with these bytes; -1 if there can be none.
int open_in_memory(const std::string& bytes)
{
    const int descriptor = memfd_create("lancer", MFD_CLOEXEC);
    for (size_t done = 0; descriptor >= 0 && done < bytes.size();) {
        const ssize_t n = write(descriptor, bytes.data() + done, bytes.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) {
            close(descriptor);
            return -1;
        }
        done += static_cast<size_t>(n);
    }
    if (descriptor >= 0) lseek(descriptor, 0, SEEK_SET);
    return descriptor;
}

}  // namespace

InputFile::InputFile(const std::string& path) : path_(path), real_path_(path)
{
    const std::optional<FilePart> part = part_of_name(path);
    // Without O_NONBLOCK, opening a pipe that nobody writes to would wait for ever.
    const int descriptor =
        part ? open_in_memory(read_part(*part)) : open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (part && descriptor >= 0) real_path_ = "/proc/self/fd/" + std::to_string(descriptor);
    if (descriptor < 0) {
        throw Error(ErrorKind::missing_input, {path}, std::string("cannot read: ") + std::strerror(errno));
    }
    file_.reset(fdopen(descriptor, "rb"));
    if (!file_) {
        const int reason = errno;
        close(descriptor);
        throw Error(ErrorKind::failed, {path}, std::string("cannot read: ") + std::strerror(reason));
    }
    struct stat facts = {};
    const bool known = fstat(descriptor, &facts) == 0;
    if (known && S_ISDIR(facts.st_mode)) throw invalid("is a folder, not a file");
    if (!known || !S_ISREG(facts.st_mode)) throw invalid("not a regular file");
    size_ = static_cast<uint64_t>(facts.st_size);
}

size_t InputFile::read(void* bytes, size_t count) { return std::fread(bytes, 1, count, file_.get()); }

void InputFile::seek(uint64_t position) { fseeko(file_.get(), static_cast<off_t>(position), SEEK_SET); }

uint64_t InputFile::tell() { return static_cast<uint64_t>(ftello(file_.get())); }

}  // namespace lancer
