// What the hard cases share: renders by both integrators whose pixels must be finite and not
// negative, measures of how far pictures are apart, and a table of all errors, printed at the end.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "../cornell_scene.h"

namespace lumivec::test {

// A suite whose tests run once for each integrator.
class each_integrator : public testing::TestWithParam<Integrator> {
 protected:
  static bool cached() { return GetParam() == Integrator::light_vectors; }
};
inline const auto integrators = testing::Values(Integrator::path, Integrator::light_vectors);
std::string integrator_name(const testing::TestParamInfo<Integrator>& info);

// The bits of terms, for RenderSettings::terms.
constexpr std::uint32_t only(Term t) {
  return 1u << static_cast<unsigned>(t);
}

// Renders by the integrator under test, or by the path tracer. Fails the test if any pixel of any
// term is negative or not finite, or if samples were dropped for that.
Framebuffer render_case(const Scene& scene, const Camera& camera, const RenderSettings& settings);
RenderSettings settings_for(Integrator integrator, int size, int samples, std::uint64_t seed = 1);

// Notes a line of the table, and fails the test if the error exceeds what is allowed. Both are
// fractions. The integrator is that of the test's parameter.
void expect_error(const std::string& name, double error, double allowed);
void expect_error(const std::string& name, Integrator integrator, double error, double allowed);

// Likewise for a defect that is known: while the error exceeds what is allowed, the test is skipped
// with the reason and the figure.
void expect_error_unless_known(const std::string& name, double error, double allowed,
                               const std::string& defect);

// Mean over all channels, and its relative error.
double mean_level(const std::vector<Color>& pixels);
double mean_error(const std::vector<Color>& pixels, double expected);

// Mean level of a term (nothing: of the sum) over pictures of successive seeds, and the standard
// error of that: pixels of one picture share records and are not independent, pictures are.
Mean mean_of_seeds(const Scene& scene, const Camera& camera, RenderSettings settings, int seeds,
                   std::optional<Term> of = {});

// √mean square over blocks of the difference of two square pictures, relative to the mean of the
// first.
double block_difference(const std::vector<Color>& a, const std::vector<Color>& b, int block);

// The largest relative difference of a pixel's channel to the value that all should have.
double largest_error(const std::vector<Color>& pixels, double expected);

// All pictures of different random numbers are alike apart from their noise: two that ought to be
// the same differ by as much as two seeds do. The √mean square of 64 blocks scatters by 1 / √(2 ·
// 64), 9%, and the ratio of two by 12.5%: half more than expected is 4 standard deviations.
constexpr double beyond_noise = 1.5;

// A closed room of diffuse surfaces: all indirect light is that of diffuse lobes.
Scene diffuse_room(CornellOptions options = {});

}  // namespace lumivec::test
