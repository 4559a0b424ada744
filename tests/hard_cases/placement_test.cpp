// Where a scene is, how large, and which way it is turned does not show.
#include "hard_case.h"

namespace lumivec::test {
namespace {

constexpr int size = 24, block = 3, samples = 4;

class placement : public each_integrator {
 protected:
  static std::vector<Color> picture(const CornellOptions& options, std::uint64_t seed = 1) {
    RenderSettings settings = settings_for(GetParam(), size, samples, seed);
    settings.terms = only(Term::indirect);
    return term(render_case(diffuse_room(options), cornell_camera(options), settings),
                Term::indirect);
  }

  static const std::vector<Color>& original() {
    static std::array<std::vector<Color>, 2> pictures;
    std::vector<Color>& p = pictures[static_cast<std::size_t>(GetParam())];
    if (p.empty()) p = picture({});
    return p;
  }

  // What other random numbers change.
  static double noise() {
    static std::array<double, 2> noises{-1.0, -1.0};
    double& n = noises[static_cast<std::size_t>(GetParam())];
    if (n < 0.0) n = block_difference(original(), picture({}, 2), block);
    return n;
  }

  static void expect_same(const std::string& name, const std::vector<Color>& changed) {
    expect_error(name, block_difference(original(), changed, block), beyond_noise * noise());
  }

  // The random numbers are the same, and the arithmetic is but for rounding.
  static void expect_equal(const std::string& name, const std::vector<Color>& changed,
                           int of_block = block) {
    expect_error(name, block_difference(original(), changed, of_block), 1e-3);
  }
};
INSTANTIATE_TEST_SUITE_P(of, placement, integrators, integrator_name);

// With powers of two the arithmetic is the same but for exponents: so is every pixel.
TEST_P(placement, scale_by_powers_of_two) {
  for (const int exponent : {-10, 20}) {
    CornellOptions o;
    o.scale = std::ldexp(1.0, exponent);
    expect_equal("size x 2^" + std::to_string(exponent), picture(o), 1);
  }
}

TEST_P(placement, scale) {
  for (const double s : {1e-3, 1e6}) {
    CornellOptions o;
    o.scale = s;
    expect_equal(s < 1.0 ? "size x 1e-3" : "size x 1e6", picture(o));
  }
}

TEST_P(placement, scale_by_the_node) {
  CornellOptions o;
  o.world = scaling(V3d(1e6));
  expect_equal("size x 1e6 by the node", picture(o));
}

TEST_P(placement, far_from_the_origin) {
  CornellOptions o;
  o.world = translation({1e5, -1e5, 1e5});
  expect_equal("1e5 from the origin", picture(o));
}

// Frames around normals turn differently: other samples of the same picture.
TEST_P(placement, rotation) {
  CornellOptions o;
  o.world = rotation({1, 2, 3}, 2.0);
  expect_same("rotated", picture(o));
}

TEST_P(placement, mirror) {
  CornellOptions o;
  o.world = scaling({-1, 1, 1});
  RenderSettings settings = settings_for(GetParam(), size, samples, 3);
  settings.terms = only(Term::indirect);
  // The camera stays: it stands on the plane of the mirror.
  const Framebuffer mirrored = render_case(diffuse_room(o), cornell_camera(), settings);
  std::vector<Color> flipped;
  for (int y = 0; y < size; ++y) {
    for (int x = size - 1; x >= 0; --x) {
      flipped.push_back(term(mirrored, Term::indirect)[std::size_t(y * size + x)]);
    }
  }
  expect_same("mirrored", flipped);
}

}  // namespace
}  // namespace lumivec::test
