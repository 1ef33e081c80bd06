#include "io/scene/fog_table.h"

namespace lancer {

FogDescription read_fog(const TomlTable& table)
{
    table.allow({"scattering", "absorption", "anisotropy", "height", "up", "min", "max"});
    FogDescription fog;
    fog.where = table.where();
    fog.scattering = table.color("scattering", brightness).value_or(fog.scattering);
    fog.absorption = table.color("absorption", brightness).value_or(fog.absorption);
    fog.anisotropy = static_cast<float>(table.number("anisotropy", below_one).value_or(0));
    fog.height = table.number("height", any_number);
    fog.z_up = table.choice("up", {"y", "z"}, 0).value_or(0) == 1;
    fog.low = table.vector("min");
    fog.high = table.vector("max");
    if (fog.height && (fog.low || fog.high)) table.error("height", " cannot be given beside 'min' and 'max'");
    if (!fog.height && table.has("up")) table.error("up", " needs a 'height'");
    if (fog.low && fog.high && !(fog.low->x < fog.high->x && fog.low->y < fog.high->y && fog.low->z < fog.high->z))
        table.error("max", " must be above 'min' along each axis");
    return fog;
}

}  // namespace lancer
