#include "render/mattes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <cstring>
#include <set>

namespace lancer {
namespace {

constexpr std::array<const char*, matte_kinds> layers{"CryptoObject", "CryptoMaterial"};
constexpr size_t ranks = 6;

std::string to_hex32(uint32_t x)
{
    std::array<char, 9> text{};
    std::snprintf(text.data(), text.size(), "%08x", x);
    return text.data();
}

// As a string of JSON, with its quotes.
std::string in_json(const std::string& text)
{
    std::string json = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') json += '\\';
        if (static_cast<unsigned char>(c) < 0x20)
            json += "\\u00" + to_hex32(static_cast<unsigned char>(c)).substr(6);
        else
            json += c;
    }
    return json + '"';
}

std::string manifest_of(const std::set<std::string>& names)
{
    std::string json = "{";
    for (const std::string& name : names)
        json += (json.size() > 1 ? "," : "") + in_json(name) + ":\"" + to_hex32(matte_id(name)) + '"';
    return json + "}";
}

// All names that object_name() may give.
std::set<std::string> names_of_objects(const Scene& scene)
{
    std::set<std::string> names;
    const auto add = [&](Kind kind, uint32_t geometry, uint32_t primitive, uint32_t instance) {
        Hit hit;
        hit.kind = kind, hit.geometry = geometry, hit.primitive = primitive, hit.instance = instance;
        names.insert(object_name(scene, hit));
    };
    const Geometry& g = scene.geometry;
    for (uint32_t i = 0; i < g.meshes.size(); ++i)
        if (!g.meshes[i].instanced) add(Kind::triangle, i, 0, Hit::no_instance);
    for (uint32_t i = 0; i < g.instances.size(); ++i) add(Kind::triangle, g.instances[i].mesh, 0, i);
    for (uint32_t i = 0; i < g.spheres.size(); ++i) add(Kind::sphere, 0, i, Hit::no_instance);
    for (uint32_t i = 0; i < g.planes.size(); ++i) add(Kind::plane, 0, i, Hit::no_instance);
    return names;
}

}  // namespace

uint32_t murmur_hash(std::string_view text)
{
    constexpr uint32_t c1 = 0xcc9e2d51, c2 = 0x1b873593;
    const auto scrambled = [](uint32_t k) { return std::rotl(k * c1, 15) * c2; };
    uint32_t hash = 0;
    const size_t whole = text.size() / 4 * 4;
    for (size_t i = 0; i < whole; i += 4) {
        uint32_t k = 0;
        std::memcpy(&k, text.data() + i, sizeof k);
        hash = std::rotl(hash ^ scrambled(k), 13) * 5 + 0xe6546b64;
    }
    uint32_t rest = 0;
    for (size_t i = text.size(); i > whole; --i) rest = rest << 8 | static_cast<uint8_t>(text[i - 1]);
    hash ^= scrambled(rest);
    hash ^= static_cast<uint32_t>(text.size());
    hash = (hash ^ hash >> 16) * 0x85ebca6b;
    hash = (hash ^ hash >> 13) * 0xc2b2ae35;
    return hash ^ hash >> 16;
}

uint32_t matte_id(std::string_view name)
{
    const uint32_t hash = murmur_hash(name), exponent = hash >> 23 & 255;
    return exponent == 0 || exponent == 255 ? hash ^ 1u << 23 : hash;
}

std::string object_name(const Scene& scene, const Hit& hit)
{
    if (hit.kind == Kind::sphere) return "sphere#" + std::to_string(hit.primitive);
    if (hit.kind == Kind::plane) return "plane#" + std::to_string(hit.primitive);
    const std::string& mesh = scene.mesh_names[hit.geometry];
    return hit.instance == Hit::no_instance ? mesh : mesh + "#" + std::to_string(hit.instance);
}

void count_matte(std::span<Matte> places, uint32_t id)
{
    for (Matte& m : places) {
        if (m.n > 0 && m.id != id) continue;
        m.id = id, ++m.n;
        return;
    }
}

std::vector<MatteManifest> matte_manifests(const Scene& scene)
{
    return {{layers[0], manifest_of(names_of_objects(scene))},
            {layers[1], manifest_of({scene.material_names.begin(), scene.material_names.end()})}};
}

std::vector<std::pair<std::string, std::string>> attributes_of(const std::vector<MatteManifest>& manifests)
{
    std::vector<std::pair<std::string, std::string>> attributes;
    for (const MatteManifest& m : manifests) {
        const std::string prefix = "cryptomatte/" + to_hex32(murmur_hash(m.layer)).substr(0, 7) + "/";
        attributes.insert(attributes.end(), {{prefix + "name", m.layer},
                                             {prefix + "hash", "MurmurHash3_32"},
                                             {prefix + "conversion", "uint32_to_float32"},
                                             {prefix + "manifest", m.names}});
    }
    return attributes;
}

std::vector<ImagePlane> matte_planes(const Film& film)
{
    std::vector<ImagePlane> planes;
    for (const char* const layer : layers)
        for (size_t r = 0; r < ranks; r += 2)
            for (const char* const channel : {".R", ".G", ".B", ".A"}) {
                planes.push_back({layer + ("0" + std::to_string(r / 2)) + channel, {}});
                planes.back().values.resize(film.pixels.size());
            }
    for (size_t i = 0; i < film.pixels.size(); ++i) {
        const double samples = film.whole_aov(i, film.aov_layout.offset(AovSum::samples));
        for (uint32_t kind = 0; kind < matte_kinds; ++kind) {
            std::array<Matte, mattes_per_kind> sorted;
            std::copy_n(&film.mattes[(i * matte_kinds + kind) * mattes_per_kind], mattes_per_kind, sorted.begin());
            std::sort(sorted.begin(), sorted.end(),
                      [](const Matte& a, const Matte& b) { return std::pair(b.n, a.id) < std::pair(a.n, b.id); });
            for (size_t r = 0; r < ranks && sorted[r].n > 0; ++r) {
                const size_t plane = (kind * ranks + r) * 2;
                planes[plane].values[i] = std::bit_cast<float>(sorted[r].id);
                planes[plane + 1].values[i] = static_cast<float>(sorted[r].n / samples);
            }
        }
    }
    return planes;
}

}  // namespace lancer
