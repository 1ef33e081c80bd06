#include "app/view/screen_bytes.h"

#include <bit>
#include <cmath>

#include "io/image/tonemap.h"

namespace lancer {
namespace {

uint8_t byte_of(double code, ToneMap map) { return static_cast<uint8_t>(code * 255 + (rounds_down(map) ? 0 : 0.5)); }

}  // namespace

void ScreenBytes::make_table(const DisplayCurve& curve)
{
    curve_ = curve;
    const double scale = std::exp2(double{curve.exposure_stops});
    table_.resize(size_t{1} << (31 - shift));
    for (uint32_t i = 0; i < table_.size(); ++i) {
        // The middle of the numbers that begin so; 0 stays 0.
        const auto x = static_cast<double>(std::bit_cast<float>(i << shift | (i ? 1u << (shift - 1) : 0u)));
        table_[i] = byte_of(to_display(curve.tonemap, {x * scale, 0, 0})[0], curve.tonemap);
    }
}

ScreenBytes::Rows ScreenBytes::update(const ShownPicture& picture, const DisplayCurve& curve, bool is_new)
{
    const bool is_other =
        table_.empty() || curve.exposure_stops != curve_.exposure_stops || curve.tonemap != curve_.tonemap;
    if (is_other) make_table(curve);
    const auto& pixels = picture.image.pixels;
    Rows rows{picture.first_row, picture.end_row};
    if (is_other || rgb_.size() != 3 * pixels.size())
        rgb_.resize(3 * pixels.size()), rows = {0, picture.image.data.height()};
    else if (!is_new)
        return {};
    const auto width = static_cast<size_t>(picture.image.data.width());
    const double scale = std::exp2(double{curve.exposure_stops});
    for (size_t i = static_cast<size_t>(rows.first) * width; i < static_cast<size_t>(rows.end) * width; ++i) {
        const Color& c = pixels[i];
        if (curve.tonemap == ToneMap::agx) {
            const auto code = to_display(ToneMap::agx, {scale * double{c.r}, scale * double{c.g}, scale * double{c.b}});
            for (size_t k = 0; k < 3; ++k) rgb_[3 * i + k] = byte_of(code[k], ToneMap::agx);
            continue;
        }
        const auto looked_up = [&](float x) {
            return x > 0 ? table_[std::bit_cast<uint32_t>(x) >> shift] : uint8_t{0};
        };
        rgb_[3 * i] = looked_up(c.r), rgb_[3 * i + 1] = looked_up(c.g), rgb_[3 * i + 2] = looked_up(c.b);
    }
    return rows;
}

}  // namespace lancer
