#include "io/scene/output_table.h"

namespace lancer {

OutputDescription read_output_table(const TomlTable& table)
{
    table.allow({"exposure", "tonemap", "denoise"});
    OutputDescription output;
    if (table.holds_text("exposure")) {
        if (table.choice("exposure", {"auto"}, 0)) output.exposure = Exposure{.is_automatic = true, .stops = 0};
    } else if (const std::optional<double> stops = table.number("exposure", -64, 64)) {
        output.exposure = Exposure{.is_automatic = false, .stops = static_cast<float>(*stops)};
    }
    const NameList names{enum_names<ToneMap>.begin(), enum_names<ToneMap>.end()};
    if (table.has("tonemap"))
        if (const std::optional<size_t> place = table.choice("tonemap", names, 0))
            output.tonemap = static_cast<ToneMap>(*place);
    output.denoise = table.boolean("denoise");
    return output;
}

}  // namespace lancer
