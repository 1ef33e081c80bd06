#include "support/images.h"

namespace lancer {

std::shared_ptr<const Raster> make_picture(const std::string& name)
{
    constexpr double turn = 2 * std::numbers::pi;
    const auto waves = [](double x, double y) {
        return 0.5 + 0.25 * (std::sin(5 * turn * x) + std::cos(3 * turn * y));
    };
    if (name == "waves") return make_bytes(64, 1, [&](double x, double y, uint32_t) { return waves(x, y); });
    if (name == "colours")
        return make_bytes(32, 3, [&](double x, double y, uint32_t c) {
            return 0.5 + 0.4 * std::sin(turn * (x * (c + 1) + y * (3 - c)));
        });
    // A slope of one towards +u everywhere, and one of a half away from +v.
    if (name == "tilted normals")
        return make_bytes(8, 3, [&](double, double, uint32_t c) {
            return 0.5 + 0.5 * (c == 0 ? -1 : c == 1 ? 0.5 : 1) / 1.5;
        });
    if (name == "flat normals")
        return make_bytes(8, 3, [&](double, double, uint32_t c) { return c == 2 ? 1.0 : 127.5 / 255; });
    // Heights that rise by one 255th from texel to texel.
    if (name == "ramp") return make_bytes(256, 1, [&](double x, double, uint32_t) { return (x * 256 - 0.5) / 255; });
    // A bright spot over a ground that is darker on one side.
    if (name == "sky")
        return make_bytes(32, 3, [&](double x, double y, uint32_t c) {
            return std::hypot(x - 0.4, y - 0.75) < 0.08 ? 1.0 : 0.3 + 0.1 * c + 0.2 * std::sin(turn * x) * y;
        });
    if (name == "discs")
        return make_bytes(
            32, 1, [&](double x, double y, uint32_t) { return std::hypot(x - 0.5, y - 0.5) < 0.35 ? 0.0 : 1.0; });
    return nullptr;
}

RasterFuture test_picture(const std::string& name)
{
    std::promise<std::shared_ptr<const Raster>> promise;
    if (auto raster = make_picture(name)) {
        promise.set_value(std::move(raster));
    } else {
        promise.set_exception(std::make_exception_ptr(Error(ErrorKind::missing_input, {name}, "no such picture")));
    }
    return promise.get_future().share();
}

}  // namespace lancer
