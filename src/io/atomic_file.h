// A file that appears whole or not at all: written as NAME.tmp.PID in the same folder, made durable, then renamed
// over NAME. A reader, a full disk or a killed process never leaves half a file under the final name.
// Every file the program writes goes through here; made before a render it also finds out early that the folder
// cannot be written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

namespace lancer {

// All failures are Error(ErrorKind::failed) with the path and the system's reason. A symbolic link stays a link: the
// file it points to is replaced. A device or a pipe (/dev/null, /dev/stdout) is written directly.
class AtomicFile {
public:
    explicit AtomicFile(const std::string& path);
    ~AtomicFile();  // without commit(): removes the temporary; what stood under the name is unchanged
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void write(const void* bytes, size_t count);
    void seek(uint64_t position);
    uint64_t tell();
    // Ends writing: all is on the disk, under the temporary name. Fails also if any earlier write did, even where a
    // library in between swallowed that exception.
    void finish();
    // Puts the file under its name; finishes it first if that was not done.
    void commit();

    const std::string& path() const { return path_; }
    const std::string& temporary() const { return temporary_; }  // "" for a device or a pipe

private:
    [[noreturn]] void fail(int reason);
    void open_temporary();
    void attach(int descriptor);
    void sync_folder() const;

    std::string path_;       // as given: for messages
    std::string target_;     // with symbolic links followed
    std::string temporary_;  // what is written and renamed; "" when writing to a device
    std::FILE* file_ = nullptr;
    int reason_ = 0;  // errno of the first failure
};

// A text as a whole file.
void write_text(const std::string& path, const std::string& text);

}  // namespace lancer
