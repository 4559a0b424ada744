// The same surface, described in another way, looks the same.
#include "hard_case.h"

namespace lumivec::test {
namespace {

constexpr int size = 24, block = 3, samples = 4;

class shape : public each_integrator {
 protected:
  static std::vector<Color> picture(const Scene& scene, std::uint64_t seed = 1) {
    RenderSettings settings = settings_for(GetParam(), size, samples, seed);
    settings.terms = only(Term::indirect);
    return term(render_case(scene, cornell_camera(), settings), Term::indirect);
  }

  static const std::vector<Color>& plain_room() {
    static std::array<std::vector<Color>, 2> pictures;
    std::vector<Color>& p = pictures[static_cast<std::size_t>(GetParam())];
    if (p.empty()) p = picture(diffuse_room());
    return p;
  }

  // The random numbers are the same, and the arithmetic is but for rounding.
  static void expect_equal(const std::string& name, const std::vector<Color>& a,
                           const std::vector<Color>& b) {
    expect_error(name, block_difference(a, b, block), 1e-3);
  }
};
INSTANTIATE_TEST_SUITE_P(of, shape, integrators, integrator_name);

// Of a mesh so large that it is not flattened.
TEST_P(shape, instance_or_copy) {
  const Mesh ball = icosphere(0.3f, 6, true);
  const Material material = diffuse({0.7f, 0.5f, 0.2f});
  Scene copies = diffuse_room();
  add_mesh(copies, ball, material, translation({-0.5, -0.1, 0.2}));
  add_mesh(copies, ball, material, scaling({-1.2, 0.5, 0.8}) * translation({0.5, -0.4, 0.3}));
  Scene instances = copies;
  instances.instances.back().mesh = static_cast<int>(copies.meshes.size()) - 2;
  expect_equal("an instance or a copy", picture(copies), picture(instances));
}

TEST_P(shape, sphere_or_fine_mesh) {
  const Material material = diffuse({0.7f, 0.5f, 0.2f});
  const M44d place = scaling({1, 0.8, 1.2}) * translation({0.3, -0.3, 0.2});
  Scene exact = diffuse_room(), mesh = exact;
  add_sphere(exact, 0.35f, material, place);
  add_mesh(mesh, icosphere(0.35f, 5, true), material, place);
  // Outlines differ by a part of a pixel: as much as noise may, no more.
  const std::vector<Color> a = picture(exact);
  const double noise = block_difference(a, picture(exact, 2), block);
  expect_error("a sphere or a fine mesh", block_difference(a, picture(mesh), block),
               beyond_noise * noise);
}

TEST_P(shape, finer_tessellation) {
  CornellOptions fine;
  fine.wall_grid = 37;
  expect_equal("a wall in 2 or 2738 triangles", plain_room(), picture(diffuse_room(fine)));
}

// A second floor in the same place, and triangles without area.
TEST_P(shape, coplanar_faces) {
  const Scene plain = diffuse_room();
  Scene doubled = plain;
  add_mesh(doubled, plain.meshes[0], plain.materials[0]);
  Mesh junk;
  junk.positions = {{0, 0, 0}, {0.5f, 0, 0}, {1, 0, 0}, {0, 0, 0}};
  junk.triangles = {{0, 1, 2}, {0, 0, 0}, {0, 3, 1}};
  add_mesh(doubled, junk, plain.materials[0]);
  expect_equal("coplanar faces", plain_room(), picture(doubled));
}

}  // namespace
}  // namespace lumivec::test
