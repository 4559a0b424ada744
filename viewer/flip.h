// ꟻLIP for displayed pictures: the difference that a person sees who alternates between two
// pictures.
//
// After P. Andersson, J. Nilsson, T. Akenine-Möller, M. Oskarsson, K. Åström and M. D. Fairchild,
// "ꟻLIP: A Difference Evaluator for Alternating Images", Proceedings of the ACM on Computer
// Graphics and Interactive Techniques 3(2), 2020. All filters are applied as separable ones; a
// pair of pictures costs about 0.5 s of one core per megapixel.
#pragma once

#include <vector>

#include "viewer/picture.h"

namespace lumivec {

// The paper's usual observer: a 0.7 m wide screen of 3840 pixels, 0.7 m away.
constexpr float flip_pixels_per_degree = 67.0f;

// reference and test: sRGB-encoded, clamped to [0, 1] here; the same size (asserted). Returns one
// value in [0, 1] per pixel, 0 for no difference.
std::vector<float> flip_map(const Picture& reference, const Picture& test,
                            float pixels_per_degree = flip_pixels_per_degree);

double mean(const std::vector<float>& values);  // 0 for none

}  // namespace lumivec
