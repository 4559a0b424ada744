// A picture of another renderer, of the same scene file: the sum and each of the three terms that
// the scene has agree, in the means of blocks of pixels, which are rendered until they are known
// better than the agreement that is asked for, and over the whole picture.
#include <OpenImageIO/imageio.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "integrator/path_tracer.h"
#include "loader/load_scene.h"
#include "test_scenes.h"

namespace lumivec::test {
namespace {

constexpr int size = 512;
constexpr int block = 16;
constexpr int blocks_across = size / block;
constexpr int block_samples = 400;
constexpr int picture_samples = 4;

// One layer of the picture, by the names of its channels.
std::vector<Color> read_layer(OIIO::ImageInput& file, const std::vector<float>& pixels,
                              const std::string& prefix) {
  const OIIO::ImageSpec& spec = file.spec();
  std::array<int, 3> channels{};
  for (std::size_t c = 0; c < 3; ++c) {
    channels[c] = spec.channelindex(prefix + std::string(1, "RGB"[c]));
    EXPECT_GE(channels[c], 0) << prefix;
  }
  std::vector<Color> layer(std::size_t(size) * size, Color(0.0f));
  for (std::size_t i = 0; i < layer.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      layer[i][c] = pixels[i * std::size_t(spec.nchannels) + std::size_t(channels[std::size_t(c)])];
    }
  }
  return layer;
}

// Means over one block, and over the three channels, of each term.
using BlockMeans = std::array<double, term_count>;

// The blocks' upper left corners: every second one, as the fields of a chessboard, and none that
// touches the emitter.
std::vector<Tile> compared_blocks(const std::vector<Color>& emitted) {
  std::vector<Tile> tiles;
  for (int y = 0; y < blocks_across; ++y) {
    for (int x = 0; x < blocks_across; ++x) {
      if ((x + y) % 2 != 0) continue;
      const Tile tile{x * block, y * block, block, block};
      bool lit = false;
      for (int i = 0; i < block * block; ++i) {
        lit = lit || emitted[std::size_t((tile.y + i / block) * size + tile.x + i % block)].x > 0;
      }
      if (!lit) tiles.push_back(tile);
    }
  }
  return tiles;
}

std::vector<BlockMeans> render_blocks(const Scene& scene, const std::vector<Tile>& tiles) {
  const RenderSettings settings = square(size, block_samples);
  const TracedScene traced(scene, 0);
  const Lights lights(traced);
  const CameraView view(scene.cameras.at(0), traced, size, size);
  const PathTracer tracer(traced, lights, view, settings);
  std::vector<BlockMeans> means(tiles.size());
  tbb::parallel_for(std::size_t(0), tiles.size(), [&](std::size_t i) {
    BlockMeans& mean = means[i];
    mean.fill(0.0);
    // In steps, so that single precision is not asked to sum up too much.
    constexpr int step = 16;
    for (int first = 0; first < block_samples; first += step) {
      std::vector<PixelSums> sums(std::size_t(block) * block);
      RenderStatistics statistics;
      tracer.render_tile(tiles[i], std::uint32_t(first), step, sums, statistics);
      for (const PixelSums& sum : sums) {
        for (std::size_t t = 0; t < term_count; ++t) {
          mean[t] += double(sum.terms[t].x) + sum.terms[t].y + sum.terms[t].z;
        }
      }
    }
    for (double& m : mean) m /= 3.0 * block * block * block_samples;
  });
  return means;
}

double block_mean(const std::vector<Color>& layer, const Tile& tile) {
  double sum = 0.0;
  for (int y = tile.y; y < tile.y + tile.height; ++y) {
    for (int x = tile.x; x < tile.x + tile.width; ++x) {
      const Color& c = layer[std::size_t(y * size + x)];
      sum += double(c.x) + c.y + c.z;
    }
  }
  return sum / (3.0 * tile.width * tile.height);
}

void expect_agreement(const std::string& name, const std::vector<double>& ours,
                      const std::vector<double>& theirs) {
  std::vector<double> deviations;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    // Where no light comes at all, both agree.
    deviations.push_back(ours[i] == theirs[i] ? 0.0 : std::abs(ours[i] / theirs[i] - 1.0));
  }
  std::sort(deviations.begin(), deviations.end());
  const double median = deviations[deviations.size() / 2];
  const double ninety_five = deviations[deviations.size() * 95 / 100];
  std::cout << name << ", " << ours.size() << " blocks: median " << 100.0 * median
            << "%, 95% below " << 100.0 * ninety_five << "%\n";
  EXPECT_LT(median, 0.007) << name;
  EXPECT_LT(ninety_five, 0.02) << name;
}

TEST(cycles_reference, cornell_box) {
  const std::filesystem::path folder = std::filesystem::path(LUMIVEC_REFERENCE) / "cornell_box_1";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " does not exist";
  const auto file = OIIO::ImageInput::open((folder / "cycles.exr").string());
  ASSERT_TRUE(file) << OIIO::geterror();
  ASSERT_EQ(file->spec().width, size);
  ASSERT_EQ(file->spec().height, size);
  std::vector<float> pixels(std::size_t(size) * size * std::size_t(file->spec().nchannels));
  ASSERT_TRUE(
      file->read_image(0, 0, 0, file->spec().nchannels, OIIO::TypeDesc::FLOAT, pixels.data()));
  const std::vector<Color> sum = read_layer(*file, pixels, "");
  const std::vector<Color> emitted = read_layer(*file, pixels, "emitted.");
  const std::vector<Color> direct = read_layer(*file, pixels, "diffuse_direct.");
  const std::vector<Color> indirect = read_layer(*file, pixels, "diffuse_indirect.");

  LoadReport report;
  const Scene scene = load_scene(folder / "cornell_box_1.gltf", {}, report);
  const std::vector<Tile> tiles = compared_blocks(emitted);
  ASSERT_GT(tiles.size(), 30u);
  const std::vector<BlockMeans> means = render_blocks(scene, tiles);
  std::vector<double> ours[3], theirs[3];
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const auto mean = [&](Term t) { return means[i][static_cast<std::size_t>(t)]; };
    const std::vector<Color>* layers[3] = {&sum, &direct, &indirect};
    const double values[3] = {mean(Term::direct) + mean(Term::indirect), mean(Term::direct),
                              mean(Term::indirect)};
    for (int k = 0; k < 3; ++k) {
      ours[k].push_back(values[k]);
      theirs[k].push_back(block_mean(*layers[k], tiles[i]));
    }
    for (const Term t : {Term::emitted, Term::specular, Term::caustic}) EXPECT_EQ(mean(t), 0.0);
  }
  const Tile all{0, 0, size, size};
  expect_agreement("sum", ours[0], theirs[0]);
  expect_agreement("direct", ours[1], theirs[1]);
  expect_agreement("indirect", ours[2], theirs[2]);

  const Framebuffer picture =
      render_clean(scene, scene.cameras.at(0), square(size, picture_samples, 2));
  const auto expect_total = [&](const std::string& name, const std::vector<Color>& mine,
                                const std::vector<Color>& reference, double tolerance) {
    const double off = block_mean(mine, all) / block_mean(reference, all) - 1.0;
    std::cout << name << ", whole picture: off by " << 100.0 * off << "%\n";
    EXPECT_NEAR(off, 0.0, tolerance) << name;
  };
  expect_total("sum", beauty(picture), sum, 0.005);
  expect_total("emitted", term(picture, Term::emitted), emitted, 0.002);
  expect_total("direct", term(picture, Term::direct), direct, 0.003);
  expect_total("indirect", term(picture, Term::indirect), indirect, 0.01);
  expect_black(term(picture, Term::specular));
  expect_black(term(picture, Term::caustic));
}

}  // namespace
}  // namespace lumivec::test
