// The values of material files against another reader of them.
#ifndef TINYOBJLOADER_USE_DOUBLE
#define TINYOBJLOADER_USE_DOUBLE
#endif
#include <tiny_obj_loader.h>

#include <algorithm>
#include <sstream>

#include "io/mtl/scan.h"
#include "obj_test_support.h"

namespace lancer {
namespace {

// Where a value was given, both readers must have it.
void expect_same(const std::string& text, const std::string& file)
{
    Diagnostics diagnostics;
    const std::vector<MtlEntry> ours = scan_mtl(text, file, diagnostics);
    std::istringstream stream(text);
    std::map<std::string, int> index;
    std::vector<tinyobj::material_t> theirs;
    std::string warnings, errors;
    tinyobj::LoadMtl(&index, &theirs, &stream, &warnings, &errors);
    ASSERT_EQ(ours.size(), theirs.size()) << file;
    for (size_t i = 0; i < ours.size(); ++i) {
        const MtlEntry& a = ours[i];
        const tinyobj::material_t& b = theirs[i];
        const std::string place = file + " " + a.name;
        const auto number = [&](const MtlValue<float>& mine, double other) {
            const double said = mine ? mine.value : other;
            EXPECT_FLOAT_EQ(static_cast<float>(said), static_cast<float>(other)) << place;
        };
        const auto color = [&](const MtlValue<Color>& mine, const tinyobj::real_t* other) {
            number({mine.value.r, mine.line}, other[0]);
            number({mine.value.g, mine.line}, other[1]);
            number({mine.value.b, mine.line}, other[2]);
        };
        const auto map = [&](MtlMapKind kind, std::string other) {
            std::replace(other.begin(), other.end(), '\\', '/');
            EXPECT_EQ(a.map(kind) ? a.map(kind)->file : "", other) << place;
        };
        EXPECT_EQ(a.name, b.name);
        color(a.kd, b.diffuse);
        color(a.ks, b.specular);
        color(a.ke, b.emission);
        color(a.tf, b.transmittance);
        number(a.ns, b.shininess);
        number(a.ni, b.ior);
        number(a.d, b.dissolve);
        number(a.pr, b.roughness);
        number(a.pm, b.metallic);
        number(a.ps, b.sheen);
        number(a.pc, b.clearcoat_thickness);
        number(a.pcr, b.clearcoat_roughness);
        number(a.aniso, b.anisotropy);
        number(a.anisor, b.anisotropy_rotation);
        EXPECT_EQ(a.illum ? a.illum.value : b.illum, b.illum) << place;
        map(MtlMapKind::kd, b.diffuse_texname);
        map(MtlMapKind::ks, b.specular_texname);
        map(MtlMapKind::d, b.alpha_texname);
        map(MtlMapKind::ke, b.emissive_texname);
        map(MtlMapKind::pr, b.roughness_texname);
        map(MtlMapKind::pm, b.metallic_texname);
        map(MtlMapKind::bump, b.bump_texname);
        map(MtlMapKind::normal, b.normal_texname);
        if (const MtlMap* m = a.map(MtlMapKind::kd)) {
            EXPECT_FLOAT_EQ(m->scale.y, static_cast<float>(b.diffuse_texopt.scale[1]));
            EXPECT_FLOAT_EQ(m->offset.x, static_cast<float>(b.diffuse_texopt.origin_offset[0]));
            EXPECT_EQ(m->wrap == Wrap::clamp, b.diffuse_texopt.clamp);
        }
    }
}

TEST(MtlReference, SameValuesFromAnotherReader)
{
    expect_same(
        "newmtl a\nKd 0.123456789 .5 1e-3\nKs 1. +.25 0\nKe 17 12.5 4e2\nTf .1 .2 .3\nNs 96.078431\nNi 1.45\n"
        "d 0.612066\nillum 7\nmap_Kd -s 2 3 1 -o .5 0 0 -clamp on wood grain.png\nmap_Ks s.png\nmap_d d.png\n"
        "map_Ke e.png\nbump -bm .3 b.png\nnorm n.png\n\nnewmtl b\nPr .3\nPm 1\nmap_Pr p.png\nmap_Pm m.png\n"
        "map_Kd a\\b.png\n",
        "own text");
}

TEST(MtlReference, SameValuesOfRealFiles)
{
    std::error_code error;
    for (fs::recursive_directory_iterator i(shared_folder() / "scenes", error), end; i != end; ++i) {
        if (i->path().extension() != ".mtl") continue;
        std::ifstream in(i->path(), std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(in), {}};
        expect_same(text, i->path().filename());
    }
}

}  // namespace
}  // namespace lancer
