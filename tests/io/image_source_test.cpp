// Pictures in the background: each file once, errors through the future, nothing kept, clean ends.
#include "io/image/source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <set>
#include <thread>

#include "core/parallel.h"
#include "io/image/read.h"
#include "io/image_files.h"
#include "io/temp_folder.h"

namespace lancer {
namespace {

TEST(ImageSource, AFileAskedForTwiceIsReadOnce)
{
    const TempFolder folder;
    write_bytes(folder.file("a.tga"), tga(true));
    ImageSource source(4);
    const RasterFuture first = source.request(folder.file("a.tga")), second = source.request(folder.file("a.tga"));
    EXPECT_EQ(first.get(), second.get());
    const RasterFuture later = source.request(folder.file("a.tga"));  // arrived, and still held
    EXPECT_EQ(later.get(), first.get());
    EXPECT_EQ(first.get()->bytes.size(), 12u);
}

TEST(ImageSource, APictureLivesAsLongAsSomebodyHoldsIt)
{
    const TempFolder folder;
    const std::string path = folder.file("a.tga");
    write_bytes(path, tga(true));
    ImageSource source(1);
    RasterFuture future = source.request(path);
    std::weak_ptr<const Raster> raster = future.get();
    EXPECT_FALSE(raster.expired());
    future = {};
    // The worker lets go of it a moment after it has said so; the next picture comes after that.
    write_bytes(folder.file("b.tga"), tga(false));
    source.request(folder.file("b.tga")).get();
    EXPECT_TRUE(raster.expired());
    // It is read anew, as the file is now.
    write_bytes(path, tga(true).replace(18, 1, "\x33"));
    EXPECT_EQ(source.request(path).get()->bytes[2], 0x33);
}

// While a library is opened no thread can be started: whoever asked for the next picture would wait.
TEST(ImageSource, AllThreadsStartWithTheFirstPicture)
{
    const TempFolder folder;
    const auto threads = [] {
        std::set<std::string> all;
        for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task")) all.insert(entry.path());
        return all;
    };
    std::thread([] {}).join();  // with the first thread a sanitizer starts one of its own
    ImageSource source(3);
    const std::set<std::string> before = threads();
    const auto added = [&] {
        const std::set<std::string> now = threads();
        return std::count_if(now.begin(), now.end(), [&](const std::string& t) { return !before.count(t); });
    };
    for (int i = 0; i < 6; ++i) {
        write_bytes(folder.file(std::to_string(i) + ".tga"), tga(true));
        source.request(folder.file(std::to_string(i) + ".tga"));
        EXPECT_EQ(added(), 3) << i;
    }
}

TEST(ImageSource, ErrorsComeThroughTheFuture)
{
    const TempFolder folder;
    write_bytes(folder.file("broken.tga"), tga(true).substr(0, 20));
    ImageSource source(2);
    const RasterFuture broken = source.request(folder.file("broken.tga")), none = source.request(folder.file("none"));
    expect_error(ErrorKind::invalid_input, folder.file("broken.tga"), "ends too early", [&] { broken.get(); });
    expect_error(ErrorKind::missing_input, folder.file("none"), "No such file", [&] { none.get(); });
}

TEST(ImageSource, EndsWellWhenNobodyWaits)
{
    const TempFolder folder;
    std::vector<RasterFuture> futures;
    for (int i = 0; i < 40; ++i) write_bytes(folder.file(std::to_string(i) + ".tga"), tga(true));
    for (const unsigned threads : {0u, 1u, 3u}) {
        const ImageSource unused(threads);
        ImageSource source(threads);
        const RasterSource ask = source.source();
        for (int i = 0; i < 40; ++i) futures.push_back(ask(folder.file(std::to_string(i) + ".tga")));
    }
    // Read, or said not to be.
    for (const RasterFuture& f : futures) {
        try {
            EXPECT_EQ(f.get()->bytes.size(), 12u);
        } catch (const Error& e) {
            EXPECT_NE(std::string(e.what()).find("the request was dropped"), std::string::npos) << e.what();
        }
    }
}

TEST(ImageSource, ManyMayAskAtOnce)
{
    const TempFolder folder;
    for (int i = 0; i < 8; ++i) write_bytes(folder.file(std::to_string(i) + ".tga"), tga(i % 2));
    ImageSource source(3);
    std::vector<std::shared_ptr<const Raster>> rasters(400);
    with_threads(4, [&] {
        parallel_for(rasters.size(),
                     [&](size_t i) { rasters[i] = source.request(folder.file(std::to_string(i % 8) + ".tga")).get(); });
    });
    // All are held, so each of the files has given one picture.
    for (size_t i = 8; i < rasters.size(); ++i) EXPECT_EQ(rasters[i], rasters[i % 8]);
}

bool is_ready(const RasterFuture& future, std::chrono::milliseconds patience)
{
    return future.wait_for(patience) == std::future_status::ready;
}

// Two of 12 bytes are read ahead, and further ones when one of them is let go of, or when they are waited for.
TEST(ImageSource, NoMoreIsReadAheadThanAllowed)
{
    using namespace std::chrono_literals;
    const TempFolder folder;
    std::vector<std::string> files;
    for (int i = 0; i < 5; ++i) {
        files.push_back(folder.file(std::to_string(i) + ".tga"));
        write_bytes(files.back(), tga(true));
    }
    ImageSource source(2, 24);
    std::vector<RasterFuture> futures;
    for (const std::string& file : files) futures.push_back(source.request(file));
    for (const std::string& file : files) {
        const auto header = source.header(file);
        ASSERT_TRUE(header);
        EXPECT_EQ(header->bytes(), 12u);
    }
    const auto count_ready = [&] {
        return std::count_if(futures.begin(), futures.end(),
                             [](const RasterFuture& f) { return f.valid() && is_ready(f, 0ms); });
    };
    while (count_ready() < 2) std::this_thread::sleep_for(1ms);
    std::this_thread::sleep_for(50ms);
    EXPECT_EQ(count_ready(), 2);
    EXPECT_FALSE(is_ready(futures[4], 0ms));
    source.demand(files[4]);
    EXPECT_EQ(futures[4].get()->bytes.size(), 12u);
    std::this_thread::sleep_for(20ms);
    EXPECT_EQ(count_ready(), 3);
    futures[4] = {};
    for (RasterFuture& f : futures)
        if (f.valid() && is_ready(f, 0ms)) f = {};
    // Room for the two that are left.
    for (RasterFuture& f : futures) {
        if (f.valid()) {
            EXPECT_EQ(f.get()->bytes.size(), 12u);
        }
    }
    EXPECT_FALSE(source.header(folder.file("never asked for")));
    source.request(folder.file("missing"));
    EXPECT_FALSE(source.header(folder.file("missing")));
}

// OpenImageIO before 2.4.8.1 keeps a table of the tags it meets in profiles, which all threads write into.
TEST(ImageSource, PicturesWithColorProfilesMayBeReadAtOnce)
{
    const TempFolder folder;
    constexpr uint32_t files = 32, tags = 5000;
    const auto path = [&](uint32_t i) { return folder.file(std::to_string(i) + ".jpg"); };
    for (uint32_t i = 0; i < files; ++i) write_bytes(path(i), inks_with_profile(0x61616161 + i * tags, tags));
    ImageSource source(4);
    std::vector<RasterFuture> futures;
    for (uint32_t i = 0; i < files; ++i) futures.push_back(source.request(path(i)));
    write_bytes(folder.file("plain.jpg"), jpeg_of({168, 188, 78, 90}));
    const auto plain = read_raster(folder.file("plain.jpg"));
    for (const RasterFuture& f : futures) EXPECT_EQ(f.get()->bytes, plain->bytes);
}

}  // namespace
}  // namespace lancer
