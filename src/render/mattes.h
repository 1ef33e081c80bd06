// Cryptomatte: which objects and which materials a pixel shows, and how much of it each covers. "Cryptomatte
// Specification", version 1.2 (Psyop, 2018): a name is stored as its hash in the bits of a float; each pixel has up to
// six names with their coverage, the largest first.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/film.h"
#include "core/image.h"
#include "scene/scene.h"

namespace lancer {

// MurmurHash3_x86_32 with seed 0 (Appleby, 2011; public domain).
uint32_t murmur_hash(std::string_view text);
// The hash of a name as the bits of a float that is neither denormal, infinite nor NaN: in those the last bit of the
// exponent is flipped.
uint32_t matte_id(std::string_view name);

// What a camera ray hit: the name of the mesh, "NAME#3" of its instance 3, "sphere#0", "plane#0".
std::string object_name(const Scene& scene, const Hit& hit);

// Counts a sample for a name. places: those of its kind in the pixel.
void count_matte(std::span<Matte> places, uint32_t id);

// What readers need to know of the names of a kind, as attributes of an EXR file: its name, the hash, and the list of
// names with their ids in JSON.
struct MatteManifest {
    std::string layer;  // "CryptoObject", "CryptoMaterial"
    std::string names;  // {"NAME":"hash in eight hexadecimal digits",...}
};
std::vector<MatteManifest> matte_manifests(const Scene& scene);
std::vector<std::pair<std::string, std::string>> attributes_of(const std::vector<MatteManifest>& manifests);

// The channels CryptoObject00.R .G .B .A to CryptoObject02, likewise CryptoMaterial: two pairs of id and coverage each.
// The film must have mattes and the AOV sum of samples.
std::vector<ImagePlane> matte_planes(const Film& film);

}  // namespace lancer
