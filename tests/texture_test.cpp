#include "integrator/texture.h"

#include "test_scenes.h"

namespace lumivec::test {
namespace {

// Red grows to the right, green downwards: texel (x, y) holds (x, y) · 50.
Scene numbered(int width, int height) {
  Scene scene;
  std::vector<std::array<int, 4>> texels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) texels.push_back({50 * x, 50 * y, 0, 255});
  }
  add_image(scene, width, height, texels);
  return scene;
}

TextureMap map_of(Filter filter, Wrap u = Wrap::repeat, Wrap v = Wrap::repeat) {
  TextureMap map;
  map.image = 0;
  map.filter = filter;
  map.wrap_u = u;
  map.wrap_v = v;
  return map;
}

float column(const Scene& scene, const TextureMap& map, float u, float v = 0.1f) {
  return sample_texture(scene, map, V2f(u, v)).x * 255.0f / 50.0f;
}

TEST(texture, none_is_white) {
  EXPECT_EQ(sample_texture(Scene(), TextureMap(), V2f(0.3f, 0.7f)), V4f(1.0f));
}

TEST(texture, nearest) {
  const Scene scene = numbered(4, 2);
  const TextureMap map = map_of(Filter::nearest);
  const float expected[] = {0, 0, 1, 1, 2, 2, 3, 3};
  for (int i = 0; i < 8; ++i) {
    EXPECT_FLOAT_EQ(column(scene, map, (static_cast<float>(i) + 0.5f) / 8), expected[i]);
  }
  EXPECT_FLOAT_EQ(sample_texture(scene, map, V2f(0.1f, 0.2f)).y, 0.0f);  // the upper row
  EXPECT_FLOAT_EQ(sample_texture(scene, map, V2f(0.1f, 0.8f)).y, 50.0f / 255.0f);
}

TEST(texture, linear) {
  const Scene scene = numbered(4, 1);
  const TextureMap map = map_of(Filter::linear, Wrap::clamp_to_edge);
  EXPECT_NEAR(column(scene, map, 0.125f), 0.0f, 1e-5f);
  EXPECT_NEAR(column(scene, map, 0.25f), 0.5f, 1e-5f);
  EXPECT_NEAR(column(scene, map, 0.5f), 1.5f, 1e-5f);
  EXPECT_NEAR(column(scene, map, 0.05f), 0.0f, 1e-5f);
  EXPECT_NEAR(column(scene, map, 0.99f), 3.0f, 1e-5f);
  EXPECT_NEAR(column(scene, map_of(Filter::linear), 0.0f), 1.5f, 1e-5f);  // repeats
  EXPECT_NEAR(column(scene, map_of(Filter::linear, Wrap::mirrored_repeat), 0.0f), 0.0f, 1e-5f);
}

TEST(texture, wrap) {
  const Scene scene = numbered(4, 2);
  for (const Filter filter : {Filter::nearest, Filter::linear}) {
    const TextureMap repeat = map_of(filter);
    const TextureMap mirror = map_of(filter, Wrap::mirrored_repeat, Wrap::mirrored_repeat);
    const TextureMap clamp = map_of(filter, Wrap::clamp_to_edge, Wrap::clamp_to_edge);
    for (const float u : {0.125f, 0.375f, 0.625f, 0.875f}) {
      const float inside = column(scene, repeat, u);
      for (const float turns : {-7.0f, -2.0f, -1.0f, 1.0f, 2.0f, 1001.0f}) {
        EXPECT_NEAR(column(scene, repeat, u + turns), inside, 1e-3f) << u + turns;
        const float mirrored = static_cast<int>(turns) % 2 == 0 ? u : 1.0f - u;
        EXPECT_NEAR(column(scene, mirror, u + turns), column(scene, repeat, mirrored), 1e-3f);
        EXPECT_NEAR(column(scene, clamp, u + turns), turns < 0 ? 0.0f : 3.0f, 1e-5f);
      }
    }
    EXPECT_NEAR(sample_texture(scene, clamp, V2f(0.5f, 7.0f)).y, 50.0f / 255.0f, 1e-6f);
    EXPECT_NEAR(sample_texture(scene, mirror, V2f(0.5f, 1.1f)).y, 50.0f / 255.0f, 1e-6f);
  }
}

TEST(texture, wrap_differs_by_axis) {
  const Scene scene = numbered(4, 4);
  const TextureMap map = map_of(Filter::nearest, Wrap::clamp_to_edge, Wrap::repeat);
  const V4f texel = sample_texture(scene, map, V2f(1.3f, 1.3f));
  EXPECT_FLOAT_EQ(texel.x, 150.0f / 255.0f);
  EXPECT_FLOAT_EQ(texel.y, 50.0f / 255.0f);
}

TEST(texture, absurd_coordinates) {
  const Scene scene = numbered(4, 2);
  for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge}) {
    for (const float u : {1e30f, -1e30f, std::numeric_limits<float>::infinity(),
                          std::numeric_limits<float>::quiet_NaN(), 3e9f}) {
      const float c = column(scene, map_of(Filter::linear, wrap, wrap), u, u);
      EXPECT_GE(c, 0.0f);
      EXPECT_LE(c, 3.001f);
    }
  }
}

TEST(texture, srgb) {
  Scene scene;
  add_image(scene, 1, 1, {{0, 128, 255, 128}});
  TextureMap map = map_of(Filter::nearest);
  EXPECT_NEAR(sample_texture(scene, map, V2f(0.5f)).y, 128.0f / 255.0f, 1e-6f);
  map.encoding = Encoding::srgb;
  const V4f texel = sample_texture(scene, map, V2f(0.5f));
  EXPECT_EQ(texel.x, 0.0f);
  EXPECT_NEAR(texel.y, 0.2158605f, 1e-6f);
  EXPECT_NEAR(texel.z, 1.0f, 1e-6f);
  EXPECT_NEAR(texel.w, 128.0f / 255.0f, 1e-6f);  // alpha is linear always
}

// Decoded before interpolated: halfway between black and white is half the light.
TEST(texture, srgb_is_decoded_first) {
  Scene scene;
  add_image(scene, 2, 1, {{0, 0, 0, 255}, {255, 255, 255, 255}});
  TextureMap map = map_of(Filter::linear);
  map.encoding = Encoding::srgb;
  EXPECT_NEAR(sample_texture(scene, map, V2f(0.5f)).x, 0.5f, 1e-6f);
}

TEST(texture, floating_point_image) {
  Scene scene;
  Image image;
  image.width = 2;
  image.height = 1;
  image.rgba32f = {1e6f, 0, 0, 1, 0, 3.5f, 0, 0.25f};
  scene.images.push_back(image);
  const V4f texel = sample_texture(scene, map_of(Filter::linear), V2f(0.5f));
  EXPECT_FLOAT_EQ(texel.x, 5e5f);
  EXPECT_FLOAT_EQ(texel.y, 1.75f);
  EXPECT_FLOAT_EQ(texel.w, 0.625f);
}

// KHR_texture_transform: translation · rotation · scale on column vectors; a positive angle turns
// the coordinates clockwise in a picture whose v grows downwards … as the matrix has it.
TEST(texture, transform) {
  const Scene scene = numbered(4, 4);
  TextureMap map = map_of(Filter::nearest);
  map.uv_transform = M33f(2, 0, 0, 0, 1, 0, 0.25f, 0.5f, 1);
  const V4f texel = sample_texture(scene, map, V2f(0.1f, 0.1f));  // (0.45, 0.6)
  EXPECT_FLOAT_EQ(texel.x, 50.0f / 255.0f);
  EXPECT_FLOAT_EQ(texel.y, 100.0f / 255.0f);
  map.uv_transform = M33f(0, -1, 0, 1, 0, 0, 0, 1, 1);  // (u, v) to (v, 1 - u)
  const V4f turned = sample_texture(scene, map, V2f(0.1f, 0.6f));
  EXPECT_FLOAT_EQ(turned.x, 100.0f / 255.0f);
  EXPECT_FLOAT_EQ(turned.y, 150.0f / 255.0f);
}

}  // namespace
}  // namespace lumivec::test
