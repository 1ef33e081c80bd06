// What pictures may take together: refused by their headers, with a table, or allowed.
#include "scene/build/picture_memory.h"

#include <gtest/gtest.h>

#include <map>

#include "scene/build/scene_builder.h"
#include "support/rasters.h"
#include "support/scenes/scenes.h"

namespace lancer {
namespace {

RasterHeader header_of(uint32_t side, uint32_t channels = 3, RasterHeader::Values values = RasterHeader::Values::bytes)
{
    return {.width = side, .height = side, .channels = channels, .values = values};
}

// Lets every file be one of these; others cannot be read.
PictureMemory memory_of(uint64_t limit, std::map<std::string, RasterHeader> headers, unsigned threads = 1)
{
    PictureMemory memory{.limit = limit, .limit_text = "what there is"};
    memory.threads = threads;
    memory.header = [headers = std::move(headers)](const std::string& file) -> std::optional<RasterHeader> {
        const auto it = headers.find(file);
        return it == headers.end() ? std::nullopt : std::optional(it->second);
    };
    return memory;
}

PendingPictures textures_of(const std::vector<std::pair<std::string, Channel>>& uses)
{
    PendingPictures pending;
    const RasterFuture image = picture_source(make_raster(1, 1, [](auto...) { return Color{}; }))("");
    for (const auto& [file, channel] : uses) {
        TextureDescription t;
        t.file = file;
        t.use.channel = channel;
        pending.textures.push_back({0, t, image});
    }
    return pending;
}

std::string refusal(const PendingPictures& pending, const PictureMemory& memory, uint32_t texture_limit = 0)
{
    try {
        check_picture_memory(pending, memory, texture_limit);
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::no_memory);
        return e.what();
    }
    return "";
}

// The least limit in bytes that is enough.
uint64_t need(const PendingPictures& pending, const std::map<std::string, RasterHeader>& headers, unsigned threads = 1,
              uint32_t texture_limit = 0, uint64_t ahead = 0)
{
    uint64_t low = 0, high = uint64_t{1} << 50;
    while (low < high) {
        const uint64_t middle = (low + high) / 2;
        PictureMemory memory = memory_of(middle, headers, threads);
        memory.ahead = ahead;
        if (refusal(pending, memory, texture_limit).empty()) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

TEST(PictureMemory, CountsWhatIsKeptAndTheLargestThatAreWorkedOn)
{
    const std::map<std::string, RasterHeader> headers{{"a", header_of(1024)}, {"b", header_of(512)}};
    // 3 bytes and a third; the picture itself, and two levels of floats of a quarter and a sixteenth.
    const auto kept = [](double side) { return 4 * side * side; };
    const auto working = [](double side) { return 3 * side * side * (1 + 1.25); };
    const auto pending = textures_of({{"a", Channel::color}, {"b", Channel::color}});
    const auto near = [](uint64_t got, double expected) { EXPECT_NEAR(static_cast<double>(got), expected, 16); };
    near(need(pending, headers), kept(1024) + kept(512) + working(1024));
    near(need(pending, headers, 8), kept(1024) + kept(512) + working(1024) + working(512));
    near(need(pending, headers, 1, 0, 1000), kept(1024) + kept(512) + working(1024) + 1000);
    near(need(textures_of({{"a", Channel::color}, {"a", Channel::red}}), headers), kept(1024) * 4 / 3 + working(1024));
    EXPECT_EQ(need(textures_of({{"unknown", Channel::color}}), headers), 0u);
    // Levels of 256 and less are kept of both; what is dropped is needed while they are made.
    near(need(pending, headers, 1, 256), 2 * kept(256) + working(1024) + 3.0 * 1024 * 1024);
}

TEST(PictureMemory, EnvironmentsAndBackgroundsCount)
{
    PendingPictures pending;
    const RasterFuture image = picture_source(make_raster(1, 1, [](auto...) { return Color{}; }))("");
    LightDescription light;
    light.file = "sky";
    pending.environment = {light, image};
    const std::map<std::string, RasterHeader> headers{{"sky", header_of(1000, 3, RasterHeader::Values::floats)}};
    EXPECT_NEAR(static_cast<double>(need(pending, headers)), 1e6 * (12 + 8 + 12), 1e5);
    pending = {};
    BackgroundDescription background;
    background.sky_picture.file = "sky";
    pending.background = {background, image, {}};
    EXPECT_NEAR(static_cast<double>(need(pending, headers)), 1e6 * (12 + 12), 1e5);
}

TEST(PictureMemory, ARefusalNamesTheLargestFirstAndWhatWouldHelp)
{
    std::map<std::string, RasterHeader> headers{{"small.png", header_of(64)}, {"large.png", header_of(8192)}};
    std::vector<std::pair<std::string, Channel>> uses{{"small.png", Channel::color}, {"large.png", Channel::color}};
    for (int i = 0; i < 30; ++i) {
        uses.emplace_back("tiny" + std::to_string(i), Channel::color);
        headers[uses.back().first] = header_of(2);
    }
    EXPECT_EQ(refusal(textures_of(uses), memory_of(722'000'000, headers)), "");
    const std::string refused = refusal(textures_of(uses), memory_of(600'000'000, headers));
    for (const char* words : {"error: the pictures of this scene take 721.4 MB, and --memory allows what there is:",
                              "'large.png', 8192 x 8192", "and 12 smaller ones"})
        EXPECT_NE(refused.find(words), std::string::npos) << words << "\nin " << refused;
    EXPECT_LT(refused.find("'large.png'"), refused.find("'small.png'"));
    EXPECT_EQ(refused.find("--texture-limit"), std::string::npos) << "the picture itself does not fit so";
    std::vector<std::pair<std::string, Channel>> many;
    headers.clear();
    for (int i = 0; i < 50; ++i) {
        many.emplace_back("wall" + std::to_string(i), Channel::color);
        headers[many.back().first] = header_of(4096);
    }
    const std::string helped = refusal(textures_of(many), memory_of(2'000'000'000, headers));
    EXPECT_NE(helped.find("--texture-limit 2048 would make them fit"), std::string::npos) << helped;
}

// Nothing is waited for but what is demanded first, and a scene that is refused demands nothing.
TEST(PictureMemory, APictureIsDemandedBeforeItIsWaitedFor)
{
    MaterialDescription m = make_lambert("a", {1, 1, 1});
    m.base_color_map.emplace();
    m.base_color_map->file = "wall";
    SceneDescription d;
    d.materials = {m, make_emitter("lamp", {1, 1, 1})};
    d.spheres = {sphere_of({0, 0, 0}, 1, "a"), sphere_of({3, 0, 0}, 1, "lamp")};
    const RasterSource source = picture_source(make_raster(4, 4, [](auto...) { return Color{1, 1, 1}; }));
    std::vector<std::string> demanded;
    const auto build = [&](uint64_t limit) {
        PictureMemory memory = memory_of(limit, {{"wall", header_of(4, 3, RasterHeader::Values::floats)}});
        memory.demand = [&](const std::string& file) { demanded.push_back(file); };
        Diagnostics diagnostics;
        SceneBuilder(d, {}, diagnostics, source, memory).finish(diagnostics);
    };
    EXPECT_THROW(build(100), Error);
    EXPECT_TRUE(demanded.empty());
    build(10000);
    EXPECT_EQ(demanded, std::vector<std::string>{"wall"});
}

}  // namespace
}  // namespace lancer
