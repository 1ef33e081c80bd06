#include "app/info_json.h"

#include "app/diagnostics_json.h"
#include "app/specialisation.h"
#include "io/file_name.h"
#include "io/image/exr.h"
#include "io/image/png.h"
#include "io/image/read.h"
#include "report/json_object.h"

namespace lancer {
namespace {

int64_t whole_number(uint64_t n) { return static_cast<int64_t>(n); }

JsonObject counts(const std::map<std::string, uint64_t>& all)
{
    JsonObject object;
    for (const auto& [name, n] : all) object.count(name, whole_number(n));
    return object;
}

void add_size(JsonObject& object, int64_t width, int64_t height)
{
    object.count("width", width);
    object.count("height", height);
}

void add_metadata(JsonObject& object, const Metadata& metadata)
{
    JsonObject values;
    for (const auto& [name, value] : metadata) {
        if (const auto* text = std::get_if<std::string>(&value)) values.text(name, *text);
        if (const auto* number = std::get_if<double>(&value)) values.number(name, *number);
        if (const auto* integer = std::get_if<int64_t>(&value)) values.count(name, *integer);
    }
    object.object("metadata", values);
}

void add_exr(JsonObject& object, const std::string& path)
{
    const ExrInfo info = read_exr_info(path);
    add_size(object, info.display.width(), info.display.height());
    JsonObject pixels;
    pixels.count("x0", info.data.x0);
    pixels.count("y0", info.data.y0);
    pixels.count("x1", info.data.x1);
    pixels.count("y1", info.data.y1);
    object.object("pixels", pixels);
    std::vector<JsonObject> channels;
    for (const auto& c : info.channels) {
        JsonObject& channel = channels.emplace_back();
        channel.text("name", c.name);
        channel.text("type", c.type);
    }
    object.objects("channels", channels);
    object.text("compression", info.compression);
    object.text("color_space", name_of(info.space));
    object.count("parts", info.parts);
    if (info.tile_width > 0) object.counts("tiles", std::vector<int64_t>{info.tile_width, info.tile_height});
    add_metadata(object, info.metadata);
}

}  // namespace

std::string scene_json(const SceneFacts& f, Profile kernel, const std::vector<UnusedFeature>& unused,
                       const Diagnostics& diagnostics)
{
    JsonObject all("lancer.info/1");
    all.text("kind", "scene");
    all.text("file", f.file);
    all.count("triangles", whole_number(f.triangles));
    all.count("drawn_triangles", whole_number(f.drawn));
    all.count("vertices", whole_number(f.vertices));
    std::map<std::string, uint64_t> shapes;
    for (size_t i = 0; i < f.shapes.size(); ++i)
        if (f.shapes[i]) shapes[shape_names[i][0]] = f.shapes[i];
    all.object("shapes", counts(shapes));
    if (f.bounds.extent() > 0) {
        JsonObject bounds;
        bounds.numbers("lower", std::vector{f.bounds.lower.x, f.bounds.lower.y, f.bounds.lower.z});
        bounds.numbers("upper", std::vector{f.bounds.upper.x, f.bounds.upper.y, f.bounds.upper.z});
        all.object("bounds", bounds);
    }
    all.object("materials", counts(f.materials));
    std::vector<JsonObject> reasons, images;
    for (const SceneFacts::Reason& m : f.reasons) {
        JsonObject& reason = reasons.emplace_back();
        reason.text("material", m.name);
        reason.text("type", m.type);
        reason.text("why", m.why);
    }
    all.objects("reasons", reasons);
    all.texts("sheets", f.sheets);
    all.texts("divisions", f.divisions);
    for (const SceneFacts::ImageSize& image : f.images) {
        JsonObject& object = images.emplace_back();
        add_size(object, image.width, image.height);
        object.count("bytes", whole_number(image.bytes));
    }
    all.objects("images", images);
    all.count("other_textures", whole_number(f.other_textures));
    all.object("lights", counts(f.lights));
    all.count("emitting_triangles", whole_number(f.emitting_triangles));
    if (!f.sky.empty()) {
        all.text("sky", f.sky);
        all.text("ground", f.ground);
        all.flag("glow", f.has_glow);
    }
    all.flag("unnamed_camera", f.has_unnamed_camera);
    all.texts("cameras", f.cameras);
    JsonObject bytes;
    bytes.count("geometry", whole_number(f.bytes.geometry));
    bytes.count("shading", whole_number(f.bytes.shading));
    bytes.count("textures", whole_number(f.bytes.textures));
    bytes.count("lights", whole_number(f.bytes.lights));
    bytes.count("accelerator", whole_number(f.bytes.accelerator));
    all.object("bytes", bytes);
    all.texts("features", f.features);
    all.text("kernel", name_of(kernel));
    std::vector<std::string> left_out;
    for (const UnusedFeature& feature : unused) left_out.push_back(to_string(feature));
    all.texts("unused", left_out);
    all.objects("warnings", warning_objects(diagnostics));
    return all.to_text();
}

std::string picture_json(const std::string& path)
{
    JsonObject all("lancer.info/1");
    all.text("kind", "picture");
    all.text("file", path);
    if (extension_of(path) == ".exr") {
        add_exr(all, path);
    } else if (extension_of(path) == ".png") {
        const PngInfo info = read_png_info(path);
        add_size(all, info.width, info.height);
        all.count("channel_count", info.channels);
        all.count("bits", info.bits);
        add_metadata(all, info.metadata);
    } else {
        const RasterHeader header = read_raster_header(path);
        add_size(all, header.width, header.height);
        all.count("channel_count", header.channels);
        add_metadata(all, read_picture_metadata(path));
    }
    return all.to_text();
}

}  // namespace lancer
