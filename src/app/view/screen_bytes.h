// A picture for the screen, quickly: tone maps that treat channels alike are looked up by the leading bits of a number,
// which is within one step of 255 of what picture files get.
#pragma once

#include <vector>

#include "app/render/outputs.h"
#include "app/view/picture_store.h"

namespace lancer {

class ScreenBytes {
public:
    // Brings the bytes up to date with the picture; `changes` as the last take() told. Returns the rows that changed.
    struct Rows {
        int32_t first = 0, end = 0;
    };
    Rows update(const ShownPicture& picture, const DisplayCurve& curve, bool is_new);
    const std::vector<uint8_t>& rgb() const { return rgb_; }

private:
    void make_table(const DisplayCurve& curve);

    static constexpr int shift = 15;  // bits of a float that are not looked at: 8 of the mantissa are
    std::vector<uint8_t> table_, rgb_;
    DisplayCurve curve_;
};

}  // namespace lancer
