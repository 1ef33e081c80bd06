// Files are read in blocks by several threads: every byte arrives, and what is said of all of them does not depend on
// who read which.
#include "io/file_content.h"

#include <gtest/gtest.h>

#include <string>

#include "core/hash.h"
#include "core/parallel.h"
#include "temp_folder.h"

namespace lancer {
namespace {

class FileContentTest : public testing::Test {
protected:
    std::string write(const std::string& name, const std::string& bytes) const
    {
        write_bytes(folder_.file(name), bytes);
        return folder_.file(name);
    }
    TempFolder folder_;
};

// Longer than three blocks, and not a whole number of them.
std::string long_text()
{
    std::string text;
    for (int i = 0; text.size() < (size_t{7} << 19) + 5; ++i) text += std::to_string(i) + '\n';
    return text;
}

TEST_F(FileContentTest, HoldsEveryByteWhoeverReadsIt)
{
    const std::string text = long_text();
    const std::string path = write("long.txt", text);
    uint64_t hash = 0;
    for (const unsigned threads : {1u, 2u, 7u}) {
        with_threads(threads, [&] {
            const FileContent content(path);
            EXPECT_EQ(content.problem(), "");
            EXPECT_TRUE(content.bytes() == text);
            EXPECT_TRUE(content.is_text());
            if (threads == 1) hash = content.hash();
            EXPECT_EQ(content.hash(), hash) << threads;
        });
    }
}

TEST_F(FileContentTest, HashFollowsAnyByte)
{
    const std::string text = long_text();
    const FileContent as_it_was(write("a.txt", text));
    for (const size_t at : {size_t{0}, size_t{1} << 20, text.size() - 1}) {
        std::string other = text;
        other[at] ^= 1;
        EXPECT_NE(FileContent(write("b.txt", other)).hash(), as_it_was.hash()) << at;
    }
    const std::string swapped = text.substr(1 << 20, 1 << 20) + text.substr(0, 1 << 20) + text.substr(2 << 20);
    EXPECT_NE(FileContent(write("b.txt", swapped)).hash(), as_it_was.hash());
    EXPECT_EQ(FileContent(write("c.txt", "short")).hash(), hash_bytes("short"));
    EXPECT_EQ(FileContent(write("d.txt", "")).hash(), hash_bytes(""));
}

TEST_F(FileContentTest, FindsAZeroByteInAnyBlock)
{
    for (const size_t at : {size_t{0}, (size_t{1} << 20) - 1, size_t{3} << 20}) {
        std::string text = long_text();
        text[at] = '\0';
        EXPECT_FALSE(FileContent(write("a.txt", text)).is_text()) << at;
    }
}

TEST_F(FileContentTest, ReadsUtf16)
{
    using namespace std::string_literals;
    for (const std::string& bytes :
         {"\xFF\xFEn\0\xE9\0\x3D\xD8\x00\xDE\n\0"s, "\xFF\xFE\xFF\xFEn\0\xE9\0\x3D\xD8\x00\xDE\n\0"s,
          "\xFE\xFF\0n\0\xE9\xD8\x3D\xDE\x00\0\n"s}) {
        const FileContent content(write("a.txt", bytes));
        EXPECT_TRUE(content.is_text());
        EXPECT_EQ(content.text(), "n\xC3\xA9\xF0\x9F\x98\x80\n");
        EXPECT_EQ(content.bytes(), bytes);
    }
    EXPECT_EQ(FileContent(write("a.txt", "n\0e\0w\0"s)).text(), "new");
    EXPECT_EQ(FileContent(write("a.txt", "\xFF\xFE\x00\xDCx\0"s)).text(), "\xEF\xBF\xBDx");  // half a character
    EXPECT_FALSE(FileContent(write("a.txt", "\xFF\xFEn\0\0\0"s)).is_text());
    EXPECT_FALSE(FileContent(write("a.txt", "n\0ew"s)).is_text());
}

TEST_F(FileContentTest, LeavesOutTheByteOrderMark)
{
    const FileContent content(write("a.txt", "\xEF\xBB\xBFv 1 2 3\n"));
    EXPECT_EQ(content.text(), "v 1 2 3\n");
    EXPECT_EQ(content.bytes().size(), 11u);
    EXPECT_EQ(FileContent(write("b.txt", "")).text(), "");
}

TEST_F(FileContentTest, SaysWhyThereIsNothing)
{
    const FileContent missing(folder_.file("none.txt"));
    EXPECT_TRUE(missing.missing());
    EXPECT_EQ(missing.problem(), "no such file");
    const FileContent of_folder(folder_.path());
    EXPECT_FALSE(of_folder.missing());
    EXPECT_EQ(of_folder.problem(), "is a folder, not a file");
    EXPECT_EQ(FileContent("/dev/zero").problem(), "not a regular file");
}

}  // namespace
}  // namespace lancer
