// Materials, textures, samplers and pictures.
#include <cmath>
#include <numbers>

#include "tests/gltf_file.h"
#include "tests/png_bytes.h"

namespace {

using lumivec::AlphaMode;
using lumivec::Color;
using lumivec::Encoding;
using lumivec::Filter;
using lumivec::Material;
using lumivec::Scene;
using lumivec::V2f;
using lumivec::Wrap;

Material load_material(GltfFile& file, const char* text) {
  file.material(text);
  const Scene scene = file.load();
  return scene.materials.at(static_cast<std::size_t>(scene.instances.at(0).material));
}

Material load_material(const char* text) {
  GltfFile file;
  return load_material(file, text);
}

// One red pixel as image 0, texture 0, with UV sets 0 and 1.
void texture(GltfFile& file) {
  file.write("red.png", PngBytes(1, 1, 8, 2, {{255, 0, 0}}).file);
  file.patch(R"({"textures": [{"source": 0}], "images": [{"uri": "red.png"}]})");
  for (const char* set : {"TEXCOORD_0", "TEXCOORD_1"}) {
    file.attribute(set, file.accessor<float>("VEC2", GltfFile::float32, {0, 0, 1, 0, 0, 1}));
  }
}

lumivec::Image load_image(const std::string& bytes) {
  GltfFile file;
  texture(file);
  file.write("red.png", bytes);
  file.material(R"({"emissiveTexture": {"index": 0}})");
  Scene scene = file.load();
  EXPECT_EQ(scene.images.size(), 1u);
  return scene.images.empty() ? lumivec::Image() : std::move(scene.images[0]);
}

V2f transformed(const V2f& uv, const Imath::M33f& m) {
  return {uv.x * m[0][0] + uv.y * m[1][0] + m[2][0], uv.x * m[0][1] + uv.y * m[1][1] + m[2][1]};
}

void expect_near(const V2f& a, const V2f& b) {
  EXPECT_NEAR((a - b).length(), 0.0f, 1e-5f) << a << " " << b;
}

TEST(GltfMaterial, DefaultIsRoughWhiteMetal) {
  GltfFile file;
  const Scene scene = file.load();
  const Material& m = scene.materials.at(0);
  EXPECT_EQ(m.metallic, 1.0f);
  EXPECT_EQ(m.roughness, 1.0f);
  EXPECT_EQ(m.base_color, Color(1));
}

TEST(GltfMaterial, MetallicRoughness) {
  const Material m = load_material(R"({"name": "m", "doubleSided": true, "pbrMetallicRoughness": {
    "baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5, "roughnessFactor": 0.6}})");
  EXPECT_EQ(m.name, "m");
  EXPECT_EQ(m.base_color, Color(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(m.opacity, 0.4f);
  EXPECT_EQ(m.metallic, 0.5f);
  EXPECT_EQ(m.roughness, 0.6f);
  EXPECT_TRUE(m.double_sided);
  EXPECT_TRUE(m.thin_walled);
  EXPECT_EQ(m.alpha_mode, AlphaMode::opaque);
}

TEST(GltfMaterial, FactorsOutOfRangeAreClampedWithAWarning) {
  GltfFile file;
  const Material m = load_material(
      file, R"({"pbrMetallicRoughness": {"metallicFactor": 2, "roughnessFactor": -1}})");
  EXPECT_EQ(m.metallic, 1.0f);
  EXPECT_EQ(m.roughness, 0.0f);
  EXPECT_TRUE(file.warns("metallicFactor"));
}

TEST(GltfMaterial, AlphaModes) {
  const Material mask = load_material(R"({"alphaMode": "MASK", "alphaCutoff": 0.25})");
  EXPECT_EQ(mask.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(mask.alpha_cutoff, 0.25f);
  EXPECT_EQ(load_material(R"({"alphaMode": "BLEND"})").alpha_mode, AlphaMode::blend);
  EXPECT_EQ(load_material(R"({"alphaMode": "FOO"})").alpha_mode, AlphaMode::opaque);
}

TEST(GltfMaterial, Emission) {
  const Material m = load_material(R"({"emissiveFactor": [1, 0.5, 0],
    "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 5000000000}}})");
  EXPECT_EQ(m.emission, Color(5e9f, 2.5e9f, 0));
}

TEST(GltfMaterial, Ior) {
  EXPECT_EQ(load_material(R"({"extensions": {"KHR_materials_ior": {"ior": 1.33}}})").ior, 1.33f);
  EXPECT_EQ(load_material(R"({"extensions": {"KHR_materials_ior": {"ior": 0}}})").ior, 0.0f);
  EXPECT_EQ(load_material(R"({"extensions": {"KHR_materials_ior": {"ior": 0.5}}})").ior, 1.0f);
  EXPECT_EQ(load_material(R"({})").ior, 1.5f);
}

TEST(GltfMaterial, TransmissionAndVolume) {
  const Material thin = load_material(
      R"({"extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.7}}})");
  EXPECT_EQ(thin.transmission, 0.7f);
  EXPECT_TRUE(thin.thin_walled);
  const Material solid = load_material(R"({"extensions": {"KHR_materials_volume": {
    "thicknessFactor": 1, "attenuationDistance": 2, "attenuationColor": [0, 0.5, 1]}}})");
  EXPECT_FALSE(solid.thin_walled);
  EXPECT_EQ(solid.attenuation_distance, 2.0f);
  EXPECT_GT(solid.attenuation_color.x, 0.0f);
  EXPECT_EQ(solid.attenuation_color.y, 0.5f);
  const Material flat =
      load_material(R"({"extensions": {"KHR_materials_volume": {"thicknessFactor": 0}}})");
  EXPECT_TRUE(flat.thin_walled);
}

TEST(GltfMaterial, Specular) {
  GltfFile file;
  texture(file);
  const Material m = load_material(file, R"({"extensions": {"KHR_materials_specular": {
    "specularFactor": 0.5, "specularColorFactor": [2, 1, 0], "specularTexture": {"index": 0},
    "specularColorTexture": {"index": 0}}}})");
  EXPECT_EQ(m.specular, 0.5f);
  EXPECT_EQ(m.specular_color, Color(2, 1, 0));
  EXPECT_EQ(m.specular_map.encoding, Encoding::linear);
  EXPECT_EQ(m.specular_color_map.encoding, Encoding::srgb);
  EXPECT_EQ(m.specular_color_map.image, 0);
}

TEST(GltfMaterial, Clearcoat) {
  GltfFile file;
  texture(file);
  const Material m = load_material(file, R"({"extensions": {"KHR_materials_clearcoat": {
    "clearcoatFactor": 0.5, "clearcoatRoughnessFactor": 0.25, "clearcoatTexture": {"index": 0},
    "clearcoatRoughnessTexture": {"index": 0},
    "clearcoatNormalTexture": {"index": 0, "scale": 0.75}}}})");
  EXPECT_EQ(m.clearcoat, 0.5f);
  EXPECT_EQ(m.clearcoat_roughness, 0.25f);
  EXPECT_EQ(m.clearcoat_normal_scale, 0.75f);
  EXPECT_EQ(m.clearcoat_map.image, 0);
  EXPECT_EQ(m.clearcoat_roughness_map.image, 0);
  EXPECT_EQ(m.clearcoat_normal_map.image, 0);
}

TEST(GltfMaterial, Unlit) {
  EXPECT_TRUE(load_material(R"({"extensions": {"KHR_materials_unlit": {}}})").unlit);
}

TEST(GltfMaterial, MapsHaveTheirEncodings) {
  GltfFile file;
  texture(file);
  const Material m = load_material(file, R"({"pbrMetallicRoughness": {
    "baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 0, "texCoord": 1}},
    "normalTexture": {"index": 0, "scale": 2}, "emissiveTexture": {"index": 0}})");
  EXPECT_EQ(m.base_color_map.encoding, Encoding::srgb);
  EXPECT_EQ(m.emission_map.encoding, Encoding::srgb);
  EXPECT_EQ(m.normal_map.encoding, Encoding::linear);
  EXPECT_EQ(m.metallic_roughness_map.encoding, Encoding::linear);
  EXPECT_EQ(m.metallic_roughness_map.uv_set, 1);
  EXPECT_EQ(m.normal_scale, 2.0f);
}

TEST(GltfMaterial, Samplers) {
  GltfFile file;
  texture(file);
  file.patch(R"({"textures": [{"source": 0, "sampler": 0}],
    "samplers": [{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728}]})");
  const Material m = load_material(file, R"({"emissiveTexture": {"index": 0}})");
  EXPECT_EQ(m.emission_map.wrap_u, Wrap::clamp_to_edge);
  EXPECT_EQ(m.emission_map.wrap_v, Wrap::mirrored_repeat);
  EXPECT_EQ(m.emission_map.filter, Filter::nearest);
}

TEST(GltfMaterial, TextureTransformScalesThenTurnsThenShifts) {
  GltfFile file;
  texture(file);
  const Material m = load_material(file, R"({"emissiveTexture": {"index": 0, "texCoord": 0,
    "extensions": {"KHR_texture_transform": {"offset": [10, 20], "rotation": 1.5707963267948966,
    "scale": [2, 3], "texCoord": 1}}}})");
  EXPECT_EQ(m.emission_map.uv_set, 1);
  expect_near(transformed(V2f(1, 0), m.emission_map.uv_transform), V2f(10, 18));
  expect_near(transformed(V2f(0, 1), m.emission_map.uv_transform), V2f(13, 20));
}

// The Khronos model TextureTransformTest marks where the tip of its arrow, at (0.778, 0.778), is to
// appear.
TEST(GltfMaterial, TextureTransformTurnsAsTheSampleModelSays) {
  GltfFile file;
  texture(file);
  const Material m = load_material(file, R"({"emissiveTexture": {"index": 0,
    "extensions": {"KHR_texture_transform": {"rotation": 0.39269908169872414}}}})");
  expect_near(transformed(V2f(0.4209518f, 1.0162675f), m.emission_map.uv_transform),
              V2f(0.7778175f, 0.7778175f));
}

TEST(GltfMaterial, MissingUvSetsAreFilledWithAWarning) {
  GltfFile file;
  texture(file);
  file.material(R"({"emissiveTexture": {"index": 0, "texCoord": 3}})");
  const Scene scene = file.load();
  EXPECT_EQ(scene.meshes[0].uvs.size(), 4u);
  EXPECT_EQ(scene.meshes[0].uvs[3].size(), 3u);
  EXPECT_TRUE(file.warns("UV sets"));
}

TEST(GltfMaterial, ImagesAreDecodedOnceAndOnlyIfUsed) {
  GltfFile file;
  texture(file);
  file.patch(R"({"textures": [{"source": 0}, {"source": 0}, {"source": 1}],
    "images": [{"uri": "red.png", "name": "red"}, {"uri": "../unused.png"}]})");
  file.material(R"({"emissiveTexture": {"index": 0}, "normalTexture": {"index": 1}})");
  const Scene scene = file.load();
  ASSERT_EQ(scene.images.size(), 1u);
  EXPECT_EQ(scene.images[0].name, "red");
  EXPECT_EQ(scene.images[0].rgba8, (std::vector<std::uint8_t>{255, 0, 0, 255}));
}

TEST(GltfMaterial, ImagesInsideBuffersAndDataUris) {
  GltfFile file;
  texture(file);
  const std::string png = PngBytes(1, 1, 8, 2, {{1, 2, 3}}).file;
  const int view = file.view(std::vector<std::uint8_t>(png.begin(), png.end()));
  file.root["images"][0] = {{"bufferView", view}, {"mimeType", "image/png"}};
  file.material(R"({"emissiveTexture": {"index": 0}})");
  EXPECT_EQ(file.load().images.at(0).rgba8, (std::vector<std::uint8_t>{1, 2, 3, 255}));
}

TEST(GltfMaterial, PicturesOfEveryKind) {
  EXPECT_EQ(load_image(PngBytes(2, 1, 8, 0, {{7, 9}}).file).rgba8,
            (std::vector<std::uint8_t>{7, 7, 7, 255, 9, 9, 9, 255}));
  EXPECT_EQ(load_image(PngBytes(8, 1, 1, 0, {{0x80}}).file).rgba8[0], 255);
  EXPECT_EQ(load_image(PngBytes(1, 1, 8, 4, {{7, 128}}).file).rgba8,
            (std::vector<std::uint8_t>{7, 7, 7, 128}));
  EXPECT_EQ(load_image(PngBytes(1, 1, 8, 6, {{200, 100, 50, 0}}).file).rgba8,
            (std::vector<std::uint8_t>{200, 100, 50, 0}));  // not multiplied by alpha
  EXPECT_EQ(load_image(PngBytes(1, 1, 8, 3, {{1}}, "abcdef").file).rgba8,
            (std::vector<std::uint8_t>{'d', 'e', 'f', 255}));
}

TEST(GltfMaterial, DeepPicturesBecomeFloats) {
  const lumivec::Image image =
      load_image(PngBytes(1, 1, 16, 2, {{0x80, 0, 0xff, 0xff, 0, 0}}).file);
  ASSERT_EQ(image.rgba32f.size(), 4u);
  EXPECT_TRUE(image.rgba8.empty());
  EXPECT_NEAR(image.rgba32f[0], 32768.0f / 65535.0f, 1e-6f);
  EXPECT_EQ(image.rgba32f[1], 1.0f);
  EXPECT_EQ(image.rgba32f[3], 1.0f);
}

TEST(GltfMaterial, RowZeroIsAtTheTop) {
  const lumivec::Image image = load_image(PngBytes(1, 2, 8, 0, {{10}, {20}}).file);
  EXPECT_EQ(image.rgba8[0], 10);
  EXPECT_EQ(image.rgba8[4], 20);
}

TEST(GltfMaterial, BadPicturesLeaveTheFactor) {
  const std::string good = PngBytes(2, 2, 8, 0, {{7, 9}, {7, 9}}).file;
  for (const std::string& bytes :
       {std::string(), std::string("no picture"), good.substr(0, 20), good.substr(0, 45)}) {
    GltfFile file;
    texture(file);
    file.write("red.png", bytes);
    file.material(R"({"emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0}})");
    const Scene scene = file.load();
    EXPECT_TRUE(scene.images.empty());
    EXPECT_EQ(scene.materials[0].emission_map.image, -1);
    EXPECT_EQ(scene.materials[0].emission, Color(1));
    EXPECT_TRUE(file.warns("/images/0")) << bytes.size();
  }
}

TEST(GltfMaterial, MissingAndRemotePicturesAreWarnings) {
  for (const char* uri : {"none.png", "http://example.com/a.png", "data:image/png;base64,!!"}) {
    GltfFile file;
    texture(file);
    file.root["images"][0]["uri"] = uri;
    file.material(R"({"emissiveTexture": {"index": 0}})");
    EXPECT_TRUE(file.load().images.empty());
    EXPECT_TRUE(file.warns("/images/0")) << uri;
  }
}

TEST(GltfMaterial, PicturesOutsideTheFolderAreErrors) {
  GltfFile file;
  texture(file);
  file.root["images"][0]["uri"] = "../../etc/passwd";
  file.material(R"({"emissiveTexture": {"index": 0}})");
  EXPECT_TRUE(contains(file.error(), "/images/0: file ../../etc/passwd lies outside"));
}

TEST(GltfMaterial, PicturesThatUnfoldPastTheLimitAreErrors) {
  GltfFile file;
  texture(file);
  file.write("red.png", PngBytes(60000, 60000, 8, 6, {{1, 2, 3, 4}}).file);
  file.options.max_bytes = 1 << 20;
  file.material(R"({"emissiveTexture": {"index": 0}})");
  EXPECT_TRUE(contains(file.error(), "limit"));
}

TEST(GltfMaterial, WebpSourceIsPreferred) {
  GltfFile file;
  texture(file);
  file.patch(R"({"textures": [{"extensions": {"EXT_texture_webp": {"source": 0}}}]})");
  const Material m = load_material(file, R"({"emissiveTexture": {"index": 0}})");
  EXPECT_EQ(m.emission_map.image, 0);
}

TEST(GltfMaterial, TexturesWithoutASupportedImageAreLeftOut) {
  GltfFile file;
  texture(file);
  file.patch(R"({"textures": [{"extensions": {"KHR_texture_basisu": {"source": 0}}}]})");
  file.root["textures"][0].erase("source");
  const Material m = load_material(file, R"({"emissiveTexture": {"index": 0}})");
  EXPECT_EQ(m.emission_map.image, -1);
  EXPECT_TRUE(file.warns("no image of a supported kind"));
}

}  // namespace
