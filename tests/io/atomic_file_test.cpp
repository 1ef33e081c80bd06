#include "io/atomic_file.h"

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <thread>

#include "io/temp_folder.h"

namespace lancer {
namespace {

void write_text(const std::string& path, const std::string& text)
{
    AtomicFile file(path);
    file.write(text.data(), text.size());
    file.commit();
}

// No file of this process may grow beyond a limit while this lives: a disk that runs full.
class FullDisk {
public:
    explicit FullDisk(rlim_t bytes)
    {
        old_handler_ = std::signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &old_);
        rlimit now = old_;
        now.rlim_cur = bytes;
        setrlimit(RLIMIT_FSIZE, &now);
    }
    ~FullDisk()
    {
        setrlimit(RLIMIT_FSIZE, &old_);
        std::signal(SIGXFSZ, old_handler_);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

private:
    rlimit old_ = {};
    void (*old_handler_)(int) = nullptr;
};

TEST(AtomicFile, AppearsOnlyAtCommit)
{
    for (const AtomicFile::Temporary how : {AtomicFile::Temporary::unnamed, AtomicFile::Temporary::named}) {
        const TempFolder folder;
        const std::string path = folder.file("a.txt");
        {
            AtomicFile file(path, how);
            file.write("new text", 8);
            // A process that is killed now leaves this behind.
            const std::string name = "a.txt.tmp." + std::to_string(getpid());
            EXPECT_EQ(folder.names(),
                      how == AtomicFile::Temporary::named ? std::vector{name} : std::vector<std::string>{});
            EXPECT_FALSE(std::filesystem::exists(path));
            file.seek(4);
            file.write("word", 4);
            EXPECT_EQ(file.tell(), 8u);
            file.commit();
        }
        EXPECT_EQ(read_bytes(path), "new word");
        EXPECT_EQ(folder.names(), std::vector<std::string>{"a.txt"});
    }
}

TEST(AtomicFile, WithoutCommitTheOldFileStaysAndNothingElse)
{
    const TempFolder folder;
    const std::string path = folder.file("a.txt");
    write_bytes(path, "old");
    for (const AtomicFile::Temporary how : {AtomicFile::Temporary::unnamed, AtomicFile::Temporary::named}) {
        AtomicFile file(path, how);
        file.write("new", 3);
    }
    EXPECT_EQ(read_bytes(path), "old");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.txt"});
}

TEST(AtomicFile, ReplacesAFileAndKeepsItsPermissions)
{
    const TempFolder folder;
    const std::string path = folder.file("a.txt");
    write_bytes(path, "old");
    chmod(path.c_str(), 0640);
    write_text(path, "new");
    EXPECT_EQ(read_bytes(path), "new");
    struct stat facts = {};
    ASSERT_EQ(stat(path.c_str(), &facts), 0);
    EXPECT_EQ(facts.st_mode & 07777, 0640u);
}

TEST(AtomicFile, ALinkStaysALink)
{
    const TempFolder folder;
    write_bytes(folder.file("real.txt"), "old");
    std::filesystem::create_symlink("real.txt", folder.file("link.txt"));
    write_text(folder.file("link.txt"), "new");
    EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link.txt")));
    EXPECT_EQ(read_bytes(folder.file("real.txt")), "new");
}

TEST(AtomicFile, AFolderThatCannotBeWrittenIsFoundAtOnce)
{
    const TempFolder folder;
    write_bytes(folder.file("file"), "");
    const std::string below_file = folder.file("file/a.txt"), in_nowhere = folder.file("none/a.txt");
    expect_error(ErrorKind::failed, below_file, "Not a directory", [&] { AtomicFile file(below_file); });
    expect_error(ErrorKind::failed, in_nowhere, "No such file or directory", [&] { AtomicFile file(in_nowhere); });
    expect_error(ErrorKind::failed, folder.path(), "Is a directory", [&] { AtomicFile file(folder.path()); });
    expect_error(ErrorKind::failed, "empty", "cannot write", [&] { AtomicFile file(""); });
    expect_error(ErrorKind::failed, "/proc/a.txt", "cannot write", [&] { AtomicFile file("/proc/a.txt"); });
}

TEST(AtomicFile, AFullDiskLeavesTheOldFile)
{
    const TempFolder folder;
    const std::string path = folder.file("a.txt");
    write_bytes(path, "old");
    {
        const FullDisk full(1000);
        const std::string text(100000, 'x');
        expect_error(ErrorKind::failed, path, "free some space", [&] { write_text(path, text); });
    }
    EXPECT_EQ(read_bytes(path), "old");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.txt"});
}

TEST(AtomicFile, AFailureThatALibrarySwallowedIsSeenAtCommit)
{
    const TempFolder folder;
    const std::string path = folder.file("a.txt");
    {
        AtomicFile file(path);
        {
            const FullDisk full(1000);
            const std::string text(100000, 'x');
            EXPECT_THROW(file.write(text.data(), text.size()), Error);
        }
        expect_error(ErrorKind::failed, path, "File too large", [&] { file.commit(); });
    }
    EXPECT_TRUE(folder.names().empty());
}

TEST(AtomicFile, ADeviceIsWrittenDirectlyAndItsErrorsAreReported)
{
    const TempFolder folder;
    std::filesystem::create_symlink("/dev/full", folder.file("full"));
    expect_error(ErrorKind::failed, folder.file("full"), "No space left on device",
                 [&] { write_text(folder.file("full"), "text"); });
    EXPECT_NO_THROW(write_text("/dev/null", "text"));
    struct stat facts = {};
    ASSERT_EQ(stat("/dev/null", &facts), 0);
    EXPECT_TRUE(S_ISCHR(facts.st_mode));
}

// Writers seek, and what only looks whether a file can be written must not end the pipe for its reader.
TEST(AtomicFile, APipeGetsTheWholeAtOnce)
{
    const TempFolder folder;
    const std::string path = folder.file("pipe");
    ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
    {
        const AtomicFile probe(path);
    }
    std::string got;
    std::thread reader([&] { got = read_bytes(path); });
    {
        AtomicFile file(path);
        file.write("1234", 4);
        file.seek(1);
        file.write("x", 1);
        EXPECT_EQ(file.tell(), 2u);
        file.commit();
    }
    reader.join();
    EXPECT_EQ(got, "1x34");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"pipe"});
}

TEST(AtomicFile, TwoAtOnceForOneNameDoNotMix)
{
    const TempFolder folder;
    const std::string path = folder.file("a.txt");
    for (const AtomicFile::Temporary how : {AtomicFile::Temporary::unnamed, AtomicFile::Temporary::named}) {
        AtomicFile first(path, how), second(path, how);
        first.write("first", 5);
        second.write("second", 6);
        second.commit();
        EXPECT_EQ(read_bytes(path), "second");
        first.commit();
        EXPECT_EQ(read_bytes(path), "first");
    }
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.txt"});
}

}  // namespace
}  // namespace lancer
