#include "hard_case.h"

#include <cstdio>

namespace lumivec::test {
namespace {

struct Line {
  std::string name;
  Integrator integrator;
  double error, allowed;
};

std::vector<Line>& lines() {
  static std::vector<Line> all;
  return all;
}

class Table : public testing::Environment {
 public:
  void TearDown() override {
    std::printf("\n%-52s %-13s %10s %10s\n", "hard case", "integrator", "error", "allowed");
    for (const Line& l : lines()) {
      std::printf("%-52s %-13s %9.4f%% %9.4f%%%s\n", l.name.c_str(),
                  integrator_names[static_cast<std::size_t>(l.integrator)].data(), 100.0 * l.error,
                  100.0 * l.allowed, l.error <= l.allowed ? "" : "  <-- too much");
    }
  }
};
const testing::Environment* const table = testing::AddGlobalTestEnvironment(new Table);

}  // namespace

std::string integrator_name(const testing::TestParamInfo<Integrator>& info) {
  return info.param == Integrator::path ? "path" : "light_vectors";
}

RenderSettings settings_for(Integrator integrator, int size, int samples, std::uint64_t seed) {
  RenderSettings settings = square(size, samples, seed);
  settings.integrator = integrator;
  return settings;
}

Framebuffer render_case(const Scene& scene, const Camera& camera, const RenderSettings& settings) {
  Framebuffer picture = render_clean(scene, camera, settings);
  for (std::size_t t = 0; t < term_count; ++t) {
    const auto bad =
        std::count_if(picture.terms[t].begin(), picture.terms[t].end(), [](const Color& c) {
          return !(std::isfinite(c.x + c.y + c.z) && c.x >= 0.0f && c.y >= 0.0f && c.z >= 0.0f);
        });
    EXPECT_EQ(bad, 0) << "pixels that are negative or not finite in " << term_names[t];
  }
  return picture;
}

void expect_error(const std::string& name, Integrator integrator, double error, double allowed) {
  lines().push_back({name, integrator, error, allowed});
  EXPECT_LE(error, allowed) << name;
}

void expect_error(const std::string& name, double error, double allowed) {
  expect_error(name, testing::WithParamInterface<Integrator>::GetParam(), error, allowed);
}

void expect_error_unless_known(const std::string& name, double error, double allowed,
                               const std::string& defect) {
  const Integrator integrator = testing::WithParamInterface<Integrator>::GetParam();
  if (integrator == Integrator::path || error <= allowed) {
    expect_error(name, integrator, error, allowed);
    return;
  }
  lines().push_back({name, integrator, error, allowed});
  GTEST_SKIP() << name << ": " << defect << "; error " << 100.0 * error << "%, allowed "
               << 100.0 * allowed << "%";
}

Mean mean_of_seeds(const Scene& scene, const Camera& camera, RenderSettings settings, int seeds,
                   std::optional<Term> of) {
  if (of) settings.terms = only(*of);
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < seeds; ++i, ++settings.seed) {
    const Framebuffer picture = render_case(scene, camera, settings);
    const double level = mean_level(of ? term(picture, *of) : beauty(picture));
    sum += level;
    squares += level * level;
  }
  const double mean = sum / seeds;
  return {mean, std::sqrt(std::max(0.0, squares / seeds - mean * mean) / (seeds - 1))};
}

double mean_level(const std::vector<Color>& pixels) {
  return (mean_of(pixels, 0).value + mean_of(pixels, 1).value + mean_of(pixels, 2).value) / 3.0;
}

double mean_error(const std::vector<Color>& pixels, double expected) {
  return std::abs(mean_level(pixels) / expected - 1.0);
}

double block_difference(const std::vector<Color>& a, const std::vector<Color>& b, int block) {
  const int size = static_cast<int>(std::lround(std::sqrt(double(a.size()))));
  const std::vector<Color> ba = blocks(a, size, block), bb = blocks(b, size, block);
  double squares = 0.0;
  for (std::size_t i = 0; i < ba.size(); ++i) {
    const Color d = ba[i] - bb[i];
    squares += (double(d.x) * d.x + double(d.y) * d.y + double(d.z) * d.z) / 3.0;
  }
  const double level = mean_level(a);
  const double root = std::sqrt(squares / static_cast<double>(ba.size()));
  return root > 0.0 ? root / level : 0.0;
}

double largest_error(const std::vector<Color>& pixels, double expected) {
  double largest = 0.0;
  for (const Color& p : pixels) {
    for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(p[c] / expected - 1.0));
  }
  return largest;
}

Scene diffuse_room(CornellOptions options) {
  options.specular = false;
  Scene scene = cornell_scene(options);
  for (Material& m : scene.materials) {
    m.metallic = 0.0f;
    m.specular = 0.0f;
  }
  return scene;
}

}  // namespace lumivec::test
