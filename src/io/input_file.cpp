#include "io/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace lancer {

InputFile::InputFile(const std::string& path) : path_(path)
{
    // Without O_NONBLOCK, opening a pipe that nobody writes to would wait for ever.
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
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
