// A file that appears whole or not at all: written without a name in the same folder, made durable, then put under
// NAME. A reader, a full disk or a killed process never leaves half a file, under this name or another. Where the file
// system knows no files without names (NFS, some overlays), it is NAME.tmp.PID while it is written, which a killed
// process leaves behind. Every file the program writes goes through here; made before a render it also finds out early
// that the folder cannot be written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

namespace lancer {

// All failures are Error(ErrorKind::failed) with the path and the system's reason. A symbolic link stays a link: the
// file it points to is replaced. A device (/dev/null) is written directly. What a pipe gets (/dev/stdout, a FIFO) waits
// in a file without a name until commit(), which may wait for a reader: writers may seek, and a probe leaves no trace.
class AtomicFile {
public:
    // How it is written until it is whole. named: also where it could do without.
    enum class Temporary { unnamed, named };

    explicit AtomicFile(const std::string& path, Temporary temporary = Temporary::unnamed);
    ~AtomicFile();  // without commit(): what was written is gone; what stood under the name is unchanged
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void write(const void* bytes, size_t count);
    void seek(uint64_t position);
    uint64_t tell();
    // Ends writing: all is on the disk, not yet under its name. Fails also if any earlier write did, even where a
    // library in between swallowed that exception.
    void finish();
    // Puts the file under its name; finishes it first if that was not done.
    void commit();

    const std::string& path() const { return path_; }
    const std::string& temporary() const { return temporary_; }  // "" for one without a name, a device or a pipe

private:
    [[noreturn]] void fail(int reason);
    bool open_unnamed();
    void open_temporary();
    // Calls take(name) with names until one is free: it then returns 0, else errno.
    template <class Take>
    void find_free_name(const Take& take);
    void close_file();
    void attach(int descriptor);
    void send_to_pipe();
    void sync_folder() const;

    std::string path_;       // as given: for messages
    std::string target_;     // with symbolic links followed
    std::string temporary_;  // the name until it is renamed, if it has one
    bool is_unnamed_ = false;
    bool is_pipe_ = false;
    std::FILE* file_ = nullptr;
    int reason_ = 0;  // errno of the first failure
};

// A text as a whole file.
void write_text(const std::string& path, const std::string& text);

}  // namespace lancer
