// What materials of glTF files become.
#include <filesystem>

#include "core/image.h"
#include "gltf_file.h"
#include "io/file_part.h"
#include "io/gltf/gltf.h"
#include "io/image/png.h"
#include "io/image/read.h"
#include "io/temp_folder.h"
#include "materials/anisotropic.h"
#include "obj_test_support.h"

namespace lancer {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class GltfMaterials : public ObjTest {
protected:
    void SetUp() override
    {
        ObjTest::SetUp();
        Image picture = make_image(2, 2);
        picture.at(0, 0) = {1, 0, 0}, picture.at(1, 1) = {0, 0, 1};
        write_png(write("wood.png", ""), picture);
        png_ = read_bytes((folder_ / "wood.png").string()) + std::string(6, '\xff');  // gives slashes in base64
    }

    // The material of a triangle. Texture 0 is wood.png.
    MaterialDescription material(const std::string& members, const std::string& more = "")
    {
        GltfFile file = triangle("\"material\":0");
        file.rest = "\"materials\":[{" + members +
                    "}],\"images\":[{\"uri\":\"wood.png\"}],\"textures\":[{\"source\":0}" + more + "]";
        return first_of(file);
    }
    MaterialDescription first_of(const GltfFile& file)
    {
        diagnostics_ = {};
        mesh_ = load_gltf(write("a.glb", file.glb()), diagnostics_);
        EXPECT_TRUE(mesh_) << errors();
        return mesh_ ? mesh_->materials.at(0) : MaterialDescription{};
    }
    static GltfFile triangle(const std::string& members)
    {
        GltfFile file;
        file.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
        file.add<float>({0, 0, 1, 0, 0, 1}, "VEC2");
        file.add<float>({0.5, 0.5, 0.75, 0.5, 0.5, 0.75}, "VEC2");
        file.add_mesh("\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1,\"TEXCOORD_1\":2}," + members);
        return file;
    }

    std::string png_;
    std::shared_ptr<const MeshData> mesh_;
};

std::string pbr(const std::string& members) { return "\"pbrMetallicRoughness\":{" + members + "}"; }
std::string extension(const std::string& name, const std::string& members)
{
    return "\"extensions\":{\"" + name + "\":{" + members + "}}";
}

TEST_F(GltfMaterials, MetallicRoughnessIsMetalPlasticOrAMixOfBoth)
{
    const MaterialDescription metal = material("\"name\":\"steel\"," + pbr("\"baseColorFactor\":[0.5,0.25,1,0.1]"));
    EXPECT_EQ(metal.name, "steel");
    EXPECT_EQ(metal.type, MaterialType::metal);
    EXPECT_EQ(metal.base_color, (Color{0.5f, 0.25f, 1}));
    EXPECT_EQ(metal.roughness, 1);
    EXPECT_EQ(metal.opacity, 1) << "opaque unless alphaMode says otherwise";
    const MaterialDescription plastic = material(pbr("\"metallicFactor\":0,\"roughnessFactor\":0.25"));
    EXPECT_EQ(plastic.name, "material 0");
    EXPECT_EQ(plastic.type, MaterialType::plastic);
    EXPECT_EQ(plastic.roughness, 0.25f);
    EXPECT_EQ(plastic.ior, 1.5f);
    EXPECT_EQ(material(pbr("\"metallicFactor\":0.5")).metallic, 0.5f);

    const MaterialDescription mapped = material(
        pbr("\"baseColorTexture\":{\"index\":0},\"metallicRoughnessTexture\":{\"index\":0},\"metallicFactor\":0.75"));
    EXPECT_EQ(mapped.type, MaterialType::plastic);
    EXPECT_EQ(mapped.metallic, 0.75f);
    EXPECT_EQ(mapped.metallic_map->use.channel, Channel::blue);
    EXPECT_EQ(mapped.roughness_map->use.channel, Channel::green);
    EXPECT_EQ(mapped.roughness_map->use.encoding, Encoding::linear);
    EXPECT_EQ(mapped.base_color_map->use.encoding, Encoding::of_file);
    EXPECT_EQ(mapped.base_color_map->file, (folder_ / "wood.png").string());
    EXPECT_THAT(mesh_->uvs, ElementsAre(Vec2{0, 1}, Vec2{1, 1}, Vec2{0, 0})) << "v points up here";
    EXPECT_THAT(warnings(), IsEmpty());
}

TEST_F(GltfMaterials, EmissionHasItsStrengthAndSides)
{
    const std::string strong = extension("KHR_materials_emissive_strength", "\"emissiveStrength\":8");
    const MaterialDescription lamp =
        material("\"emissiveFactor\":[1,0.5,0],\"doubleSided\":true,\"emissiveTexture\":{\"index\":0}," + strong);
    EXPECT_EQ(lamp.emission, (Color{8, 4, 0}));
    EXPECT_TRUE(lamp.emission_both_sides);
    EXPECT_TRUE(lamp.emission_map);
    EXPECT_FALSE(material("\"emissiveFactor\":[1,0.5,0]").emission_both_sides);
    EXPECT_FALSE(material("\"emissiveTexture\":{\"index\":0}").emission_map) << "the factor is black by default";
    const MaterialDescription unlit =
        material(pbr("\"baseColorFactor\":[0.5,0.5,0.5,1],\"baseColorTexture\":{\"index\":0}") + "," +
                 extension("KHR_materials_unlit", ""));
    EXPECT_EQ(unlit.emission, (Color{0.5f, 0.5f, 0.5f}));
    EXPECT_TRUE(unlit.emission_map && unlit.emission_both_sides && is_black(unlit.base_color));
}

TEST_F(GltfMaterials, AlphaIsOpacityAndAMaskIsAStep)
{
    const std::string colored = pbr("\"baseColorFactor\":[1,1,1,0.5],\"baseColorTexture\":{\"index\":0}");
    EXPECT_EQ(material(colored).opacity, 1);
    const MaterialDescription blend = material("\"alphaMode\":\"BLEND\"," + colored);
    EXPECT_EQ(blend.opacity, 0.5f);
    EXPECT_EQ(blend.opacity_map->use.channel, Channel::alpha);
    const MaterialDescription mask = material("\"alphaMode\":\"MASK\",\"alphaCutoff\":0.25," + colored);
    const auto opacity = [&](float alpha) {
        return mask.opacity * (alpha * mask.opacity_map->use.gain + mask.opacity_map->use.bias);
    };
    EXPECT_GE(opacity(0.5f), 1) << "0.25 is the cutoff itself";
    EXPECT_GE(opacity(0.75f), 1);
    EXPECT_LE(opacity(0.49f), 0);
    const std::string plain = pbr("\"baseColorFactor\":[1,1,1,0.5]");
    EXPECT_EQ(material("\"alphaMode\":\"MASK\"," + plain).opacity, 1);
    EXPECT_EQ(material("\"alphaMode\":\"MASK\",\"alphaCutoff\":0.6," + plain).opacity, 0);
    EXPECT_THAT(warnings(), IsEmpty());
}

TEST_F(GltfMaterials, AlphaOfVertexColoursFadesWhatBlends)
{
    const auto alphas = [&](const std::string& members, double last) {
        GltfFile file;
        file.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
        file.add<float>({1, 1, 1, 0.25, 1, 1, 1, 1, 1, 1, 1, last}, "VEC4");
        file.add_mesh("\"attributes\":{\"POSITION\":0,\"COLOR_0\":1},\"material\":0");
        file.rest = "\"materials\":[{" + members + "}]";
        first_of(file);
        return mesh_->alphas;
    };
    EXPECT_EQ(alphas("\"alphaMode\":\"BLEND\"", 0.5), (std::vector<float>{0.25f, 1, 0.5f}));
    EXPECT_THAT(alphas("\"alphaMode\":\"OPAQUE\"", 0.5), IsEmpty());
    EXPECT_THAT(warnings(), IsEmpty());
    EXPECT_THAT(alphas("\"alphaMode\":\"MASK\"", 0.5), IsEmpty());
    EXPECT_THAT(warnings(), ElementsAre(HasSubstr("is not used with alphaMode MASK")));
}

TEST_F(GltfMaterials, TransmissionIsASheetOrABody)
{
    const std::string colored = pbr("\"baseColorFactor\":[0.25,1,1,1],\"roughnessFactor\":0");
    const std::string passes = "\"KHR_materials_transmission\":{\"transmissionFactor\":1}";
    const MaterialDescription sheet = material(colored + ",\"extensions\":{" + passes + "}");
    EXPECT_EQ(sheet.type, MaterialType::glass);
    EXPECT_EQ(sheet.thin, true);
    EXPECT_EQ(sheet.base_color, (Color{0.5f, 1, 1})) << "light crosses two faces";
    const MaterialDescription body =
        material(colored + ",\"extensions\":{" + passes +
                 ",\"KHR_materials_ior\":{\"ior\":1.33},\"KHR_materials_volume\":{\"thicknessFactor\":1,"
                 "\"attenuationDistance\":2,\"attenuationColor\":[0.1353352832366127,1,1]}}");
    EXPECT_EQ(body.thin, false);
    EXPECT_EQ(body.ior, 1.33f);
    EXPECT_NEAR(body.absorption.r, 1, 1e-6);
    EXPECT_EQ(body.absorption.g, 0);
    EXPECT_THAT(warnings(), IsEmpty());
}

TEST_F(GltfMaterials, AVolumeMayScatter)
{
    const auto body = [&](const std::string& scatter) {
        return material(
            "\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1},"
            "\"KHR_materials_volume\":{\"thicknessFactor\":1,\"attenuationDistance\":2,"
            "\"attenuationColor\":[0.1353352832366127,0.1353352832366127,1]},"
            "\"KHR_materials_volume_scatter\":{" +
            scatter + "}}");
    };
    const MaterialDescription milk = body("\"multiscatterColor\":[0.9,0.5,0.25],\"scatterAnisotropy\":0.5");
    EXPECT_EQ(milk.subsurface_color, (Color{0.9f, 0.5f, 0.25f}));
    EXPECT_NEAR(milk.subsurface_radius.r, 1, 1e-6);
    EXPECT_NEAR(milk.subsurface_radius.b, 1e6f, 1);
    EXPECT_EQ(milk.scattering_anisotropy, 0.5f);
    EXPECT_TRUE(is_black(milk.absorption));
    const MaterialDescription clear = body("\"multiscatterColor\":[0,0,0]");
    EXPECT_FALSE(clear.subsurface_color);
    EXPECT_NEAR(clear.absorption.r, 1, 1e-6);
    EXPECT_THAT(warnings(), IsEmpty());
}

TEST_F(GltfMaterials, APartOfTransmissionIsPrincipled)
{
    const MaterialDescription m =
        material(pbr("\"baseColorFactor\":[0.25,1,1,1],\"metallicFactor\":0.5,\"roughnessFactor\":0.125") + "," +
                 extension("KHR_materials_transmission", "\"transmissionFactor\":0.25"));
    EXPECT_EQ(m.type, MaterialType::principled);
    EXPECT_EQ(m.transmission, 0.25f);
    EXPECT_EQ(m.metallic, 0.5f);
    EXPECT_EQ(m.roughness, 0.125f);
    EXPECT_EQ(m.base_color, (Color{0.25f, 1, 1}));
    EXPECT_EQ(m.transmittance, (Color{0.5f, 1, 1})) << "light crosses two faces";
    EXPECT_EQ(m.thin, true);
    EXPECT_THAT(warnings(), IsEmpty());
}

TEST_F(GltfMaterials, LayersThatNoPlainMaterialHasArePrincipled)
{
    const MaterialDescription coated =
        material(extension("KHR_materials_clearcoat", "\"clearcoatFactor\":0.5,\"clearcoatRoughnessFactor\":0.125"));
    EXPECT_EQ(coated.type, MaterialType::principled);
    EXPECT_EQ(coated.metallic, 1.0f) << "which a file says of nothing else";
    EXPECT_EQ(coated.coat, 0.5f);
    EXPECT_EQ(coated.coat_roughness, 0.125f);
    EXPECT_EQ(coated.coat_ior, 1.5f);
    EXPECT_EQ(coated.coat_darkening, 0);
    const MaterialDescription sheen =
        material(pbr("\"metallicFactor\":0") + "," +
                 extension("KHR_materials_sheen", "\"sheenColorFactor\":[0.5,0.25,0],\"sheenRoughnessFactor\":0.75"));
    EXPECT_EQ(sheen.fuzz, 0.5f);
    EXPECT_EQ(sheen.fuzz_color, (Color{1, 0.5f, 0}));
    EXPECT_EQ(sheen.fuzz_roughness, 0.75f);
    EXPECT_EQ(sheen.metallic, 0.0f);
    const MaterialDescription film =
        material(extension("KHR_materials_iridescence",
                           "\"iridescenceFactor\":0.75,\"iridescenceIor\":1.5,\"iridescenceThicknessMaximum\":600"));
    EXPECT_EQ(film.film, 0.75f);
    EXPECT_EQ(film.film_ior, 1.5f);
    EXPECT_EQ(film.film_thickness, 600);
    EXPECT_THAT(warnings(), IsEmpty());
}

// The wider alpha is r^2 + (1 - r^2) s^2, the narrower one r^2.
TEST_F(GltfMaterials, AnisotropyHasTheAlphasOfTheSpecification)
{
    const MaterialDescription m =
        material(pbr("\"roughnessFactor\":0.5") + "," +
                 extension("KHR_materials_anisotropy", "\"anisotropyStrength\":0.5,\"anisotropyRotation\":1.5707963"));
    const AlphaPair alpha = alphas_of(m.roughness, m.anisotropy);
    EXPECT_NEAR(alpha.along, 0.25f + 0.75f * 0.25f, 1e-5f);
    EXPECT_NEAR(alpha.across, 0.25f, 1e-5f);
    EXPECT_NEAR(m.anisotropy_rotation, 0.25f, 1e-6f);
    EXPECT_THAT(warnings(), IsEmpty());
}

TEST_F(GltfMaterials, SpecularGoesAsFarAsPlasticDoes)
{
    const MaterialDescription plastic = material(
        pbr("\"metallicFactor\":0") +
        ",\"extensions\":{\"KHR_materials_ior\":{\"ior\":1.8},\"KHR_materials_specular\":{\"specularFactor\":0.5,"
        "\"specularColorFactor\":[1,0.5,0]}}");
    EXPECT_EQ(plastic.ior, 1.8f);
    EXPECT_EQ(plastic.specular, (Color{0.5f, 0.25f, 0}));
    EXPECT_EQ(plastic.type, MaterialType::plastic);
    EXPECT_THAT(warnings(), IsEmpty());
}

TEST_F(GltfMaterials, SpecularGlossinessIsConverted)
{
    const char* const name = "KHR_materials_pbrSpecularGlossiness";
    const MaterialDescription dull = material(extension(
        name, "\"diffuseFactor\":[0.8,0.1,0.1,1],\"specularFactor\":[0.04,0.04,0.04],\"glossinessFactor\":0.75"));
    EXPECT_EQ(dull.type, MaterialType::plastic);
    EXPECT_EQ(dull.base_color, (Color{0.8f, 0.1f, 0.1f}));
    EXPECT_NEAR(dull.ior, 1.5, 1e-6);
    EXPECT_EQ(dull.roughness, 0.25f);
    const MaterialDescription gold =
        material(extension(name, "\"diffuseFactor\":[0,0,0,1],\"specularFactor\":[1,0.8,0.3]"));
    EXPECT_EQ(gold.type, MaterialType::metal);
    EXPECT_EQ(gold.base_color, (Color{1, 0.8f, 0.3f}));
    EXPECT_EQ(gold.roughness, 0);
    const MaterialDescription mapped =
        material(extension(name, "\"specularGlossinessTexture\":{\"index\":0},\"glossinessFactor\":0.5"));
    EXPECT_EQ(mapped.roughness_map->use.channel, Channel::alpha);
    EXPECT_EQ(mapped.roughness_map->use.gain, -0.5f);
    EXPECT_EQ(mapped.roughness_map->use.bias, 1);
}

TEST_F(GltfMaterials, TextureTransformsMoveLookups)
{
    const auto textured = [](const std::string& transform) {
        return "{\"index\":0," + extension("KHR_texture_transform", transform) + "}";
    };
    const MaterialDescription scaled =
        material(pbr("\"baseColorTexture\":" + textured("\"offset\":[0.25,0.125],\"scale\":[2,4]")));
    const ImageUse& use = scaled.base_color_map->use;
    EXPECT_EQ(use.scale, (Vec2{2, 4}));
    // The upper left corner of the picture, v = 1 here, is looked up at (0.25, 1 - 0.125).
    EXPECT_EQ(use.offset.x, 0.25f);
    EXPECT_EQ(1 * use.scale.y + use.offset.y, 1 - 0.125f);
    EXPECT_EQ(mesh_->uvs[0], (Vec2{0, 1}));

    const MaterialDescription turned =
        material(pbr("\"baseColorTexture\":" + textured("\"rotation\":1.5707963267948966")));
    EXPECT_EQ(turned.base_color_map->use.scale, (Vec2{1, 1}));
    // (1, 0) turned counter-clockwise, with v downwards, is (0, -1).
    EXPECT_NEAR(mesh_->uvs[1].x, 0, 1e-6);
    EXPECT_NEAR(mesh_->uvs[1].y, 2, 1e-6);
    EXPECT_THAT(warnings(), IsEmpty());

    const MaterialDescription two = material(pbr("\"baseColorTexture\":" + textured("\"texCoord\":1")) +
                                             ",\"emissiveFactor\":[1,1,1],\"emissiveTexture\":{\"index\":0}");
    EXPECT_EQ(mesh_->uvs[1], (Vec2{0.75f, 0.5f}));
    EXPECT_EQ(mesh_->second_uvs[1], (Vec2{1, 1}));
    EXPECT_FALSE(two.base_color_map->use.by_second_uv);
    EXPECT_TRUE(two.emission_map->use.by_second_uv);
    EXPECT_THAT(warnings(), IsEmpty());

    material(pbr("\"baseColorTexture\":" + textured("\"texCoord\":1")));
    EXPECT_THAT(mesh_->second_uvs, IsEmpty()) << "what no texture uses is not kept";
    const MaterialDescription third = material(
        pbr("\"baseColorTexture\":{\"index\":0}") +
        ",\"normalTexture\":{\"index\":0,\"texCoord\":1},\"emissiveFactor\":[1,1,1],\"emissiveTexture\":{\"index\":0,"
        "\"texCoord\":2}");
    EXPECT_TRUE(third.normal_map->use.by_second_uv);
    EXPECT_FALSE(third.emission_map);
    EXPECT_THAT(warnings(), ElementsAre(HasSubstr("a third set of texture coordinates")));
}

TEST_F(GltfMaterials, TangentsAreReadWhereANormalMapUsesThem)
{
    const auto read = [&](const std::string& members, const std::string& nodes) {
        GltfFile file;
        file.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
        file.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
        file.add<float>({0, 0, 1, 0, 0, 1}, "VEC2");
        file.add<float>({1, 0, 0, 1, 0, 2, 0, -1, 0, 0, 0, 1}, "VEC4");
        file.add_mesh("\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_0\":2,\"TANGENT\":3},\"material\":0");
        file.rest = "\"materials\":[{" + members +
                    "}],\"images\":[{\"uri\":\"wood.png\"}],\"textures\":[{\"source\":0}]" + nodes;
        first_of(file);
        return mesh_->tangents;
    };
    const std::string mapped = "\"normalTexture\":{\"index\":0}";
    const auto plain = read(mapped, "");
    ASSERT_EQ(plain.size(), 3u);
    EXPECT_EQ(plain[0].along, (Vec3{1, 0, 0}));
    EXPECT_EQ(plain[1].along, (Vec3{0, 1, 0}));
    EXPECT_EQ(plain[0].sign, 1);
    EXPECT_EQ(plain[1].sign, -1);
    EXPECT_EQ(plain[2].along, Vec3{}) << "has no length";
    EXPECT_THAT(warnings(), ElementsAre(HasSubstr("tangent of zero length")));
    EXPECT_THAT(read(pbr("\"baseColorTexture\":{\"index\":0}"), ""), IsEmpty());
}

TEST_F(GltfMaterials, SamplersRepeatOrClamp)
{
    const auto wrap = [&](const std::string& sampler) {
        GltfFile file = triangle("\"material\":0");
        file.rest =
            "\"materials\":[{" + pbr("\"baseColorTexture\":{\"index\":0}") +
            "}],\"images\":[{\"uri\":\"wood.png\"}],\"textures\":[{\"source\":0,\"sampler\":0}],\"samplers\":[{" +
            sampler + "}]";
        return first_of(file).base_color_map->use.wrap;
    };
    EXPECT_EQ(wrap(""), Wrap::repeat);
    EXPECT_EQ(wrap("\"wrapS\":33071,\"wrapT\":33071"), Wrap::clamp);
    EXPECT_THAT(warnings(), IsEmpty());
    EXPECT_EQ(wrap("\"wrapS\":33648"), Wrap::repeat);
    EXPECT_THAT(warnings(), ElementsAre(HasSubstr("mirrored repeat")));
    wrap("\"magFilter\":9728");
    EXPECT_THAT(warnings(), ElementsAre(HasSubstr("NEAREST")));
}

TEST_F(GltfMaterials, PicturesWithinAFileAreReadByTheirNames)
{
    const auto file_of = [&](const std::string& image, bool as_text) {
        GltfFile file = triangle("\"material\":0");
        const size_t view = image.empty() ? file.add_view(png_) : 0;  // else it would stand there, too
        const std::string own = image.empty() ? "\"bufferView\":" + std::to_string(view) : image;
        file.rest = "\"materials\":[{" + pbr("\"baseColorTexture\":{\"index\":0}") + "}],\"images\":[{" + own +
                    ",\"mimeType\":\"image/png\"}],\"textures\":[{\"source\":0}]";
        diagnostics_ = {};
        const auto mesh = load_gltf(write("a.gltf", as_text ? file.embedded() : file.glb()), diagnostics_);
        EXPECT_TRUE(mesh) << errors();
        EXPECT_THAT(warnings(), IsEmpty());
        return mesh->materials[0].base_color_map->file;
    };
    const auto outside = read_raster((folder_ / "wood.png").string());
    const std::string base64 = to_base64(png_);
    std::string escaped;
    for (const char c : base64) (c == '/' ? escaped += '\\' : escaped) += c;
    ASSERT_NE(base64, escaped);
    const std::string last = file_of("\"uri\":\"data:image/png;base64," + escaped + "\"", true);
    EXPECT_THAT(relative(last), testing::StartsWith("a.gltf#image0@"));
    EXPECT_EQ(read_raster(last)->bytes, outside->bytes);
    const std::string plain = file_of("\"uri\":\"data:image/png;base64," + base64 + "\"", false);
    EXPECT_EQ(read_raster(plain)->bytes, outside->bytes);
    const std::string in_text = file_of("", true);
    EXPECT_EQ(read_raster(in_text)->bytes, outside->bytes);
    EXPECT_EQ(read_raster_header(in_text).width, 2u);
    const std::string in_binary = file_of("", false);
    EXPECT_EQ(read_raster(in_binary)->bytes, outside->bytes);
}

TEST_F(GltfMaterials, PicturesThatAreMissingAreWarnings)
{
    GltfFile file = triangle("\"material\":0");
    file.rest = "\"materials\":[{" + pbr("\"baseColorTexture\":{\"index\":0}") +
                "}],\"images\":[{\"uri\":\"none%20such.png\"}],\"textures\":[{\"source\":0}]";
    EXPECT_FALSE(first_of(file).base_color_map);
    EXPECT_THAT(warnings(), ElementsAre(HasSubstr("images[0]: texture file 'none%20such.png' not found; not used")));
}

TEST(FilePart, NamesAreReadBack)
{
    const FilePart plain{"dir/a b.glb", "image3", 12, 345}, coded{"x#1.gltf", "image0", 1, 2, FilePart::Range{3, 4}};
    EXPECT_EQ(name_of(plain), "dir/a b.glb#image3@12+345");
    EXPECT_EQ(part_of_name(name_of(plain)), plain);
    EXPECT_EQ(part_of_name(name_of(coded)), coded);
    for (const char* name : {"a.png", "a#b.png", "a.glb#image@1", "a.glb#image@1+", "a.glb#image@1+2~3", "#i@1+2",
                             "a.glb#im/age@1+2", "a.glb#image@-1+2", "a.glb#image@1+99999999999999999999"})
        EXPECT_FALSE(part_of_name(name)) << name;
}

TEST(FilePart, BeyondTheEndIsRefused)
{
    const TempFolder folder;
    write_bytes(folder.file("a.bin"), "0123456789");
    EXPECT_EQ(read_part({folder.file("a.bin"), "part", 2, 3}), "234");
    for (const FilePart& part :
         {FilePart{folder.file("a.bin"), "part", 8, 3}, FilePart{folder.file("a.bin"), "part", 11, 0},
          FilePart{folder.file("a.bin"), "part", 1, UINT64_MAX},
          FilePart{folder.file("a.bin"), "part", 0, 8, FilePart::Range{6, 1}}})
        expect_error(ErrorKind::invalid_input, "a.bin#part@", "ends too early", [&] { read_part(part); });
}

}  // namespace
}  // namespace lancer
