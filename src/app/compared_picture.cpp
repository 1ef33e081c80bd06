#include "app/compared_picture.h"

#include <algorithm>

#include "io/image/exr.h"
#include "io/image/read.h"

namespace lancer {
namespace {

void read_variance(ComparedPicture& picture)
{
    constexpr const char* name = "variance.V";
    const ExrInfo info = read_exr_info(picture.path);
    const bool is_half =
        std::any_of(info.channels.begin(), info.channels.end(), [](const auto& c) { return c.type == "half"; });
    picture.rounding = is_half ? 0x1p-11 : 0x1p-24;
    const bool has_variance =
        std::any_of(info.channels.begin(), info.channels.end(), [&](const auto& c) { return c.name == name; });
    if (!has_variance)
        picture.no_variance = "has no variance channel (render with --aov variance)";
    else if (picture.said("spp_done") == "1" || picture.said("spp_done") == "0")
        picture.no_variance = "has no variance: that takes two samples per pixel or more";
    else
        picture.variance = read_exr_channel(picture.path, name);
}

}  // namespace

std::optional<std::string> ComparedPicture::said(const std::string& name) const
{
    const MetadataValue* const found = find_value(metadata, name);
    return found ? std::optional(to_string(*found)) : std::nullopt;
}

ComparedPicture read_compared(const std::string& path)
{
    ComparedPicture picture;
    picture.path = path;
    PictureKind kind;
    picture.image = read_image(path, Encoding::of_file, &kind);
    picture.is_float = kind.is_float;
    picture.no_variance = "has no variance channel (render an EXR with --aov variance)";
    picture.metadata = read_picture_metadata(path);
    if (kind.format == "openexr") read_variance(picture);
    return picture;
}

std::optional<std::string> shared_seed(const ComparedPicture& a, const ComparedPicture& b)
{
    const auto seed = a.said("seed");
    return seed && seed == b.said("seed") ? seed : std::nullopt;
}

}  // namespace lancer
