#include "io/mtl/scan.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "core/names.h"
#include "io/file_finder.h"
#include "io/mtl/kind.h"
#include "io/text_file.h"

namespace lancer {
namespace {

constexpr float largest = std::numeric_limits<float>::max();

struct ColorKey {
    std::string_view name;
    MtlValue<Color> MtlEntry::*member;
    float most;
    const char* outside;
};
constexpr std::array color_keys{
    ColorKey{"Kd", &MtlEntry::kd, 1, "Kd outside [0, 1] clamped"},
    ColorKey{"Ks", &MtlEntry::ks, 1, "Ks outside [0, 1] clamped"},
    ColorKey{"Tf", &MtlEntry::tf, 1, "Tf outside [0, 1] clamped"},
    ColorKey{"Ke", &MtlEntry::ke, largest, "Ke below 0 or beyond float clamped"},
};

struct NumberKey {
    std::string_view name;
    MtlValue<float> MtlEntry::*member;
    float least, most;
    const char* outside;
};
constexpr std::array number_keys{
    NumberKey{"Ns", &MtlEntry::ns, 0, largest, "Ns below 0 or beyond float clamped"},
    NumberKey{"Ni", &MtlEntry::ni, 0.001f, 10, "Ni outside [0.001, 10] clamped"},
    NumberKey{"d", &MtlEntry::d, 0, 1, "d outside [0, 1] clamped"},
    NumberKey{"Tr", &MtlEntry::tr, 0, 1, "Tr outside [0, 1] clamped"},
    NumberKey{"Pr", &MtlEntry::pr, 0, 1, "Pr outside [0, 1] clamped"},
    NumberKey{"Pm", &MtlEntry::pm, 0, 1, "Pm outside [0, 1] clamped"},
    NumberKey{"Ps", &MtlEntry::ps, 0, 1, "Ps outside [0, 1] clamped"},
    NumberKey{"Pc", &MtlEntry::pc, 0, 1, "Pc outside [0, 1] clamped"},
    NumberKey{"Pcr", &MtlEntry::pcr, 0, 1, "Pcr outside [0, 1] clamped"},
    NumberKey{"aniso", &MtlEntry::aniso, 0, 1, "aniso outside [0, 1] clamped"},
    NumberKey{"anisor", &MtlEntry::anisor, 0, 1, "anisor outside [0, 1] clamped"},
};

// MeshLab writes the alpha of a face under this name: what others call d.
constexpr NumberKey alpha_of_meshlab{"Tr", &MtlEntry::d, 0, 1, "Tr outside [0, 1] clamped"};

struct MapKey {
    std::string_view name;
    MtlMapKind kind;
};
constexpr std::array map_keys{
    MapKey{"map_Kd", MtlMapKind::kd},       MapKey{"map_Ks", MtlMapKind::ks},
    MapKey{"map_Ke", MtlMapKind::ke},       MapKey{"map_d", MtlMapKind::d},
    MapKey{"map_opacity", MtlMapKind::d},   MapKey{"map_Pr", MtlMapKind::pr},
    MapKey{"map_Pm", MtlMapKind::pm},       MapKey{"map_Ps", MtlMapKind::ps},
    MapKey{"map_Pc", MtlMapKind::pc},       MapKey{"map_Pcr", MtlMapKind::pcr},
    MapKey{"map_aniso", MtlMapKind::aniso}, MapKey{"map_anisor", MtlMapKind::anisor},
    MapKey{"map_bump", MtlMapKind::bump},   MapKey{"bump", MtlMapKind::bump},
    MapKey{"norm", MtlMapKind::normal},     MapKey{"disp", MtlMapKind::disp},
    MapKey{"map_disp", MtlMapKind::disp},
};

// Where Blender puts the textures of a Principled BSDF if it is not asked for the keys Pr and Pm.
constexpr std::array map_keys_of_principled{MapKey{"map_Ns", MtlMapKind::pr}, MapKey{"map_refl", MtlMapKind::pm},
                                            MapKey{"refl", MtlMapKind::pm}};

// What would be seen if it were supported; a value of 0 asks for nothing.
constexpr std::array<std::string_view, 9> unsupported{"Km",   "Kt",    "map_Ns",    "map_Tf",  "map_Tr",
                                                      "refl", "decal", "map_decal", "map_refl"};
// What a path tracer computes by itself, and what says how others should draw.
constexpr std::array<std::string_view, 4> without_meaning{"Ka", "map_Ka", "map_aat", "sharpness"};

// Programs write keys in any case, and no two differ in case alone.
bool is_key(std::string_view word, std::string_view name)
{
    return std::equal(word.begin(), word.end(), name.begin(), name.end(),
                      [](char a, char b) { return to_lower(a) == to_lower(b); });
}

template <class Keys>
auto find_key(const Keys& keys, std::string_view word)
{
    const auto found = std::find_if(keys.begin(), keys.end(), [&](const auto& k) { return is_key(word, k.name); });
    return found == keys.end() ? nullptr : &*found;
}

template <class Names>
bool contains(const Names& names, std::string_view word)
{
    return std::any_of(names.begin(), names.end(), [&](std::string_view name) { return is_key(word, name); });
}

float to_range(double v, float low, float high, bool& changed)
{
    const auto clamped = std::clamp(v, static_cast<double>(low), static_cast<double>(high));
    changed = changed || clamped != v;
    return static_cast<float>(clamped);
}

// A comment may stand close to a number.
std::string_view take_value(std::string_view& arguments)
{
    const std::string_view word = take_word(arguments);
    const size_t comment = word.find('#');
    if (comment != std::string_view::npos) arguments = {};
    return word.substr(0, comment);
}

// Three numbers, or one for all three. Anything else (spectral files, CIE XYZ, words) is not supported.
std::optional<Vec3d> color_values(std::string_view arguments)
{
    std::array<double, 3> v;
    size_t n = 0;
    for (std::string_view word = take_value(arguments); !word.empty(); word = take_value(arguments)) {
        if (n == 3 || classify_number(word) != NumberKind::finite) return {};
        v[n++] = number_value(word);
    }
    if (n == 1) return Vec3d{v[0], v[0], v[0]};
    return n == 3 ? std::optional(Vec3d{v[0], v[1], v[2]}) : std::nullopt;
}

std::optional<double> number_argument(std::string_view arguments)
{
    const std::string_view word = take_value(arguments);
    if (classify_number(word) != NumberKind::finite) return {};
    return number_value(word);
}

// "map_Kd textures\": the folder of a path whose file name was lost, not a line that goes on.
bool ends_in_name(std::string_view line)
{
    if (line.size() < 2 || is_blank(line[line.size() - 2])) return false;
    const std::string_view key = take_word(line);
    return !line.empty() &&
           (is_key(key.substr(0, 4), "map_") || find_key(map_keys, key) || is_key(key, "decal") || is_key(key, "refl"));
}

class Scanner {
public:
    Scanner(const std::string& file, Diagnostics& diagnostics) : file_(file), diagnostics_(diagnostics) {}

    std::vector<MtlEntry> scan(std::string_view text)
    {
        TextLines lines(text, ends_in_name);
        while (lines.next()) {
            line_ = lines.number();
            std::string_view arguments = lines.line();
            const std::string_view key = take_word(arguments);
            if (key.empty()) continue;
            if (key[0] == '#') {
                if (materials_.empty() && origin_.program == MtlProgram::other)
                    origin_ = origin_in_comment(lines.line());
                continue;
            }
            if (is_key(key, "newmtl"))
                add_material(trim(arguments));
            else if (!materials_.empty())
                use(key, arguments);
            else if (strays_++ == 0)
                first_stray_ = line_;
        }
        if (strays_)
            diagnostics_.warning({file_, first_stray_, 0}, "statement before the first newmtl ignored", strays_);
        return std::move(materials_);
    }

private:
    template <class Message>
    void warn(const Message& message)
    {
        diagnostics_.warning({file_, line_, 0}, message);
    }

    void add_material(std::string_view name)
    {
        materials_.emplace_back();
        materials_.back().name = name;
        materials_.back().line = line_;
        materials_.back().origin = origin_;
    }

    void use(std::string_view key, std::string_view arguments)
    {
        if (const ColorKey* color = find_key(color_keys, key)) return use_color(*color, arguments);
        if (origin_.program == MtlProgram::meshlab && is_key(key, alpha_of_meshlab.name))
            return use_number(alpha_of_meshlab, arguments);
        if (const NumberKey* number = find_key(number_keys, key)) return use_number(*number, arguments);
        if (const MapKey* map = find_key(map_keys, key)) return use_map(*map, arguments);
        if (is_key(key, "illum")) return use_illum(arguments);
        if (origin_.program == MtlProgram::blender && use_of_blender(key, arguments)) return;
        if (contains(without_meaning, key)) return;
        if (!contains(unsupported, key)) return warn_unknown(key);
        const std::optional<double> value = number_argument(arguments);
        if (!value || *value != 0) warn(NamedProblem{"statement", std::string(key), " is not supported; ignored"});
    }

    // Keys that mean something in a file by Blender alone.
    bool use_of_blender(std::string_view key, std::string_view arguments)
    {
        if (is_key(key, "Ka")) {
            use_color({"Ka", &MtlEntry::ka, largest, "Ka below 0 or beyond float clamped"}, arguments);
            return true;
        }
        const MapKey* const map = find_key(map_keys_of_principled, key);
        if (!map || !is_principled(materials_.back())) return false;
        use_map(*map, arguments);
        return true;
    }

    void use_color(const ColorKey& key, std::string_view arguments)
    {
        const std::optional<Vec3d> v = color_values(arguments);
        if (!v) return warn(std::string(key.name) + " is not three finite numbers; ignored");
        bool changed = false;
        const Color color{to_range(v->x, 0, key.most, changed), to_range(v->y, 0, key.most, changed),
                          to_range(v->z, 0, key.most, changed)};
        if (changed) warn(key.outside);
        materials_.back().*key.member = {color, line_};
    }

    void use_number(const NumberKey& key, std::string_view arguments)
    {
        std::string_view rest = arguments;
        if (key.name == "d" && take_word(rest) == "-halo") {
            warn("option -halo of d is not supported; d is the same from all sides");
            arguments = rest;
        }
        const std::optional<double> v = number_argument(arguments);
        if (!v) return warn(std::string(key.name) + " is not a finite number; ignored");
        // Some programs write 0 for what they do not know.
        if (key.name == "Ni" && *v <= 0) return warn("Ni is not above 0; ignored");
        bool changed = false;
        const float value = to_range(*v, key.least, key.most, changed);
        if (changed) warn(key.outside);
        materials_.back().*key.member = {value, line_};
    }

    void use_illum(std::string_view arguments)
    {
        const std::optional<double> v = number_argument(arguments);
        if (!v || !(*v >= 0 && *v <= 10) || *v != static_cast<int>(*v))
            return warn("illum is not a whole number from 0 to 10; ignored");
        materials_.back().illum = {static_cast<int>(*v), line_};
    }

    void use_map(const MapKey& key, std::string_view arguments)
    {
        std::optional<MtlMap> map = parse_mtl_map(arguments, key.name, {file_, line_, 0}, diagnostics_);
        if (!map) return;
        auto& maps = materials_.back().maps;
        const auto same = std::find_if(maps.begin(), maps.end(), [&](const auto& m) { return m.first == key.kind; });
        if (same == maps.end()) {
            maps.emplace_back(key.kind, std::move(*map));
            return;
        }
        if (same->second.file != map->file) warn(std::string(key.name) + " after another one; the last is used");
        same->second = std::move(*map);
    }

    void warn_unknown(std::string_view key)
    {
        std::vector<std::string_view> known{"newmtl", "illum"};
        for (const auto& k : color_keys) known.push_back(k.name);
        for (const auto& k : number_keys) known.push_back(k.name);
        for (const auto& k : map_keys) known.push_back(k.name);
        const std::optional<std::string> meant = nearest(key, known);
        warn(NamedProblem{"unknown statement", std::string(key),
                          " ignored" + (meant ? "; did you mean " + in_quotes(*meant) + "?" : "")});
    }

    const std::string& file_;
    Diagnostics& diagnostics_;
    std::vector<MtlEntry> materials_;
    MtlOrigin origin_;
    uint32_t line_ = 0, first_stray_ = 0;
    uint64_t strays_ = 0;
};

}  // namespace

std::vector<MtlEntry> scan_mtl(std::string_view text, const std::string& file, Diagnostics& diagnostics)
{
    return Scanner(file, diagnostics).scan(text);
}

}  // namespace lancer
