// Latitude-longitude pictures as the light from infinitely far away.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "loader/error.h"
#include "loader/load_scene.h"

namespace lumivec {
namespace {

// What half floats, the usual source of infinities, can hold.
constexpr float largest_radiance = 65504.0f;

[[noreturn]] void fail(const std::filesystem::path& file, std::string problem,
                       const std::string& remedy) {
  std::replace(problem.begin(), problem.end(), '\n', ' ');
  throw SceneError(file.string(), "", problem, remedy);
}

float linear_from_srgb(float x) {
  return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

// Channels of red, green and blue: by name, or else the first ones; all the same for a grey
// picture.
struct Channels {
  int red = 0;
  int green = 0;
  int blue = 0;
};

Channels channels_of(const OIIO::ImageSpec& spec) {
  const Channels named{spec.channelindex("R"), spec.channelindex("G"), spec.channelindex("B")};
  if (named.red >= 0 && named.green >= 0 && named.blue >= 0) return named;
  return spec.nchannels >= 3 ? Channels{0, 1, 2} : Channels{0, 0, 0};
}

float clean(float x) {
  return std::isnan(x) ? 0.0f : std::clamp(x, 0.0f, largest_radiance);
}

Image read_environment(const std::filesystem::path& file) {
  auto input = OIIO::ImageInput::open(file.string());
  if (!input) fail(file, "cannot be read as a picture: " + OIIO::geterror(), "give a .hdr or .exr");
  const OIIO::ImageSpec spec = input->spec();
  if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.deep || spec.nchannels <= 0) {
    fail(file, "holds no flat picture", "give a .hdr or .exr");
  }
  const auto pixels =
      static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(spec.height);
  const auto channels = static_cast<std::uint64_t>(spec.nchannels);
  if (channels > LoadOptions{}.max_bytes / sizeof(float) / pixels) {
    fail(file, "is too large: " + std::to_string(spec.width) + " x " + std::to_string(spec.height),
         "scale it down");
  }
  std::vector<float> values(pixels * channels);
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, values.data())) {
    fail(file, "cannot be read: " + input->geterror(), "fetch the file again");
  }
  // Integer pictures are made for screens, floating-point ones hold light.
  const bool encoded = !spec.format.is_floating_point();
  const Channels channel = channels_of(spec);
  Image image;
  image.name = file.filename().string();
  image.width = spec.width;
  image.height = spec.height;
  image.rgba32f.resize(pixels * 4);
  for (std::size_t i = 0; i < pixels; ++i) {
    const float* from = values.data() + i * channels;
    float* to = image.rgba32f.data() + 4 * i;
    const float rgb[3] = {from[channel.red], from[channel.green], from[channel.blue]};
    for (int c = 0; c < 3; ++c) to[c] = clean(encoded ? linear_from_srgb(rgb[c]) : rgb[c]);
    to[3] = 1.0f;
  }
  return image;
}

void replace_environment(Image image, float strength, float rotation, Scene& scene) {
  const int previous = scene.environment.image;
  if (previous >= 0) {
    scene.images[static_cast<std::size_t>(previous)] = std::move(image);
  } else {
    scene.environment.image = static_cast<int>(scene.images.size());
    scene.images.push_back(std::move(image));
  }
  scene.environment.radiance = Color(strength);
  scene.environment.rotation = rotation;
}

// Brightest overhead, darker toward the ground, with a wide soft light from the upper left front:
// even enough that nothing is lost in shadow, uneven enough that shapes show.
Image built_in_sky() {
  constexpr int width = 128, height = 64;
  constexpr float zenith = 0.9f, horizon = 0.6f, ground = 0.25f, key = 3.0f, sharpness = 12.0f;
  const V3f toward_key = V3f(-0.6f, 0.7f, 0.6f).normalized();
  Image image;
  image.name = "built-in sky";
  image.width = width;
  image.height = height;
  image.rgba32f.reserve(std::size_t{4} * width * height);
  for (int y = 0; y < height; ++y) {
    const float theta =
        std::numbers::pi_v<float> * (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
    for (int x = 0; x < width; ++x) {
      const float phi = 2.0f * std::numbers::pi_v<float> *
                        ((static_cast<float>(x) + 0.5f) / static_cast<float>(width) - 0.5f);
      const V3f direction(std::sin(theta) * std::sin(phi), std::cos(theta),
                          -std::sin(theta) * std::cos(phi));
      const float up = direction.y;
      float radiance = up > 0.0f ? horizon + (zenith - horizon) * up
                                 : ground + (horizon - ground) * std::exp(8.0f * up);
      radiance += key * std::pow(std::max(0.0f, direction.dot(toward_key)), sharpness);
      for (const float channel : {radiance, radiance, radiance, 1.0f})
        image.rgba32f.push_back(channel);
    }
  }
  return image;
}

}  // namespace

void set_built_in_sky(float strength, float rotation, Scene& scene) {
  replace_environment(built_in_sky(), strength, rotation, scene);
}

void load_environment(const std::filesystem::path& file, float strength, float rotation,
                      Scene& scene) {
  if (!(strength >= 0.0f) || !std::isfinite(strength) || !std::isfinite(rotation)) {
    fail(file, "environment strength must be at least 0, and rotation finite",
         "correct the options");
  }
  Image image;
  try {
    image = read_environment(file);
  } catch (const SceneError&) {
    throw;
  } catch (const std::exception& error) {
    fail(file, error.what(), "give a smaller .hdr or .exr");
  }
  replace_environment(std::move(image), strength, rotation, scene);
}

}  // namespace lumivec
