#include "scene/build/receive_environment.h"

#include <chrono>
#include <utility>

#include "scene/environment/background.h"
#include "scene/environment/environment.h"

namespace lancer {
namespace {

// Throws as what reads pictures does.
std::shared_ptr<const Raster> received(const RasterFuture& image, const Location& where, Diagnostics& diagnostics)
{
    if (!image.valid()) throw Error(ErrorKind::failed, "nothing reads pictures here");
    std::shared_ptr<const Raster> picture = image.get();
    if (!picture->damage.empty())
        diagnostics.warning(where, "the picture is damaged: " + picture->damage + "; what could be read is used");
    return picture;
}

// Lists, at its end, how long making maps and tables of the pictures took, without the wait for them.
class EnvironmentClock {
public:
    explicit EnvironmentClock(Scene& scene) : scene_(scene) {}
    ~EnvironmentClock()
    {
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin_;
        scene_.analyses.push_back({"environment", taken.count()});
    }
    EnvironmentClock(const EnvironmentClock&) = delete;
    EnvironmentClock& operator=(const EnvironmentClock&) = delete;

private:
    Scene& scene_;
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace

void receive_environment(Scene& scene, PendingPictures::OfEnvironment pending, const PictureMemory& memory,
                         Diagnostics& diagnostics)
{
    const LightDescription& light = pending.what;
    try {
        memory.wait_for(light.file);
        std::shared_ptr<const Raster> picture = received(pending.image, light.where, diagnostics);
        pending.image = {};  // the last to hold the picture shall be who makes texels of it
        const EnvironmentClock clock(scene);
        scene.environment_map = std::make_shared<EnvironmentMap>(std::move(picture), light.power, scene.environment,
                                                                 light.rotate_deg, scene.sky_compensation);
    } catch (const Error& e) {
        return diagnostics.error(light.where, std::string("environment not read: ") + e.what(), e.kind());
    }
    scene.environment_table = scene.environment_map;
    scene.environment = {};
    if (const uint64_t bad = scene.environment_map->bad_texels())
        diagnostics.warning(light.where, "a texel of the environment is negative or not finite: taken for black", bad);
}

void receive_background(Scene& scene, PendingPictures::OfBackground pending, const PictureMemory& memory,
                        uint32_t texture_limit, Diagnostics& diagnostics)
{
    const BackgroundDescription& what = pending.what;
    const auto receive = [&](const BackgroundPicture& picture, RasterFuture& image) -> std::shared_ptr<const Raster> {
        if (picture.file.empty()) return {};
        try {
            memory.wait_for(picture.file);
            return received(image, picture.where, diagnostics);
        } catch (const Error& e) {
            diagnostics.error(picture.where, std::string("background not read: ") + e.what(), e.kind());
            return {};
        }
    };
    const auto sky = receive(what.sky_picture, pending.sky), ground = receive(what.ground_picture, pending.ground);
    if ((!sky && !what.sky_picture.file.empty()) || (!ground && !what.ground_picture.file.empty())) return;
    const EnvironmentClock clock(scene);
    scene.background = std::make_shared<const Background>(what, sky.get(), ground.get(), scene.legacy, texture_limit);
    if (const uint64_t bad = scene.background->bad_texels())
        diagnostics.warning(what.where, "a texel of the background is negative or not finite: taken for black", bad);
    scene.environment_table = make_background_table(scene);
}

}  // namespace lancer
