#include "io/scene/texture_tables.h"

namespace lancer {
namespace {

Encoding encoding_for(TextureRole role) { return role == TextureRole::color ? Encoding::of_file : Encoding::linear; }

Channel channel_for(TextureRole role)
{
    if (role == TextureRole::opacity) return Channel::automatic;
    return role == TextureRole::number || role == TextureRole::heights ? Channel::luminance : Channel::color;
}

}  // namespace

std::vector<Wave> read_waves(const TomlTable& table, std::string_view key)
{
    std::vector<Wave> waves;
    for (const auto& [amplitude, direction, length, phase] :
         table.quadruples(key, "[amplitude, direction, length, phase]")) {
        if (length > 0) {
            waves.push_back({amplitude, direction, length, phase});
        } else {
            table.error(key, " must have lengths greater than 0");
        }
    }
    return waves;
}

TextureTables::TextureTables(const TomlTable& root, const AssetFolder& assets) : assets_(assets)
{
    for (const auto& [name, table] : root.named_tables("texture")) named_.emplace(name, read(table));
}

std::optional<std::string> TextureTables::find(const TomlTable& table, std::string_view key,
                                               const std::string& name) const
{
    const AssetFolder::Found found = assets_.find(name);
    if (found.problem.empty()) return found.path;
    const bool may_be_a_name = key != "file" && !named_.empty();
    std::vector<std::string_view> known;
    for (const auto& [n, texture] : named_) known.push_back(n);
    table.error(table.where(key),
                (may_be_a_name ? "no [texture.NAME] has this name, and picture " : "picture ") + in_quotes(name) + " " +
                    found.problem + (may_be_a_name ? suggestion(name, known) : ""),
                found.kind);
    return {};
}

TextureTables::Named TextureTables::read(const TomlTable& table) const
{
    const std::vector<TypedKey> keys{{"file", {"image"}},    {"encoding", {"image"}}, {"wrap", {"image"}},
                                     {"channel", {"image"}}, {"gain", {"image"}},     {"bias", {"image"}},
                                     {"uv_set", {"image"}},  {"even", {"checker"}},   {"odd", {"checker"}},
                                     {"band", {"grid"}},     {"ground", {"grid"}},    {"width", {"grid"}},
                                     {"waves", {"waves"}}};
    NameList known{"type", "scale", "offset"};
    for (const TypedKey& k : keys) known.push_back(k.key);
    table.allow(known);

    Named result;
    TextureDescription& t = result.texture;
    t.where = table.where();
    const NameList types{"image", "checker", "grid", "waves"};
    const std::optional<size_t> type = table.choice("type", types, 0);
    if (type) {
        t.type = std::array{TextureType::image, TextureType::checker, TextureType::grid, TextureType::waves}[*type];
        table.reject_keys_of_other_types(types[*type], keys);
        if (*type == 0 && table.require("file", "image"))
            if (const std::optional<std::string> file = table.text("file"))
                t.file = find(table, "file", *file).value_or("");
        if (t.type == TextureType::waves) table.require("waves", "waves");
    }
    if (table.has("encoding"))
        if (const auto i = table.choice("encoding", {"srgb", "linear"}, 0))
            result.encoding = *i == 0 ? Encoding::srgb : Encoding::linear;
    if (const auto i = table.choice("channel", {"r", "g", "b", "a", "luminance", "auto"}, 5); i && *i < 5)
        result.channel =
            std::array{Channel::red, Channel::green, Channel::blue, Channel::alpha, Channel::luminance}[*i];
    t.use.wrap = table.choice("wrap", {"repeat", "clamp"}, 0).value_or(0) == 0 ? Wrap::repeat : Wrap::clamp;
    t.use.by_second_uv = table.integer("uv_set", 0, 1).value_or(0) == 1;
    t.use.scale = table.number_or_pair("scale").value_or(t.use.scale);
    t.use.offset = table.number_or_pair("offset").value_or(t.use.offset);
    t.use.gain = static_cast<float>(table.number("gain", float_range).value_or(t.use.gain));
    t.use.bias = static_cast<float>(table.number("bias", float_range).value_or(t.use.bias));
    t.even = table.color("even", brightness).value_or(t.even);
    t.odd = table.color("odd", brightness).value_or(t.odd);
    t.band = table.color("band", brightness).value_or(t.band);
    t.ground = table.color("ground", brightness).value_or(t.ground);
    t.band_width = static_cast<float>(table.number("width", reflectance).value_or(t.band_width));
    t.waves = read_waves(table, "waves");
    return result;
}

TextureUse TextureTables::use(const TomlTable& table, std::string_view key, TextureRole role) const
{
    Named result;
    const std::optional<TomlTable> in_place = table.inner_table(key);
    const std::optional<std::string> name = in_place ? std::nullopt : table.text(key);
    if (in_place) {
        result = read(*in_place);
    } else if (!name) {
        return {};
    } else if (const auto found = named_.find(*name); found != named_.end()) {
        result = found->second;
    } else if (const std::optional<std::string> file = find(table, key, *name)) {
        result.texture.where = table.where(key);
        result.texture.file = *file;
    } else {
        return {};
    }
    if (result.texture.type == TextureType::waves && role != TextureRole::heights)
        table.error(key, " must not be waves: they are heights, for 'bump_texture' alone");
    if (result.texture.type == TextureType::checker && role == TextureRole::heights)
        table.error(key, " must be a picture: the squares of a checker have no slopes");
    if (result.texture.type == TextureType::grid && role == TextureRole::heights)
        table.error(key, " must be a picture: the bands of a grid have no slopes");
    if (result.texture.type != TextureType::image && key == "displacement_texture")
        table.error(key, " must be a picture");
    result.texture.use.encoding = result.encoding.value_or(encoding_for(role));
    result.texture.use.channel = result.channel.value_or(channel_for(role));
    return result.texture;
}

}  // namespace lancer
