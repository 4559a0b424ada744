// The measure of error that renders aim at and report: relMSE, the mean over pixels and channels of
// (x − reference)² / (reference² + 0.01) (Rousselle, Knaus and Zwicker 2011, "Adaptive Sampling and
// Reconstruction using Greedy Error Minimization").
#pragma once

namespace lumivec {

// A squared difference relative to the reference's square; radiance².
inline double relative_to(double squared_difference, double reference_square) {
  constexpr double floor = 0.01;  // of the square, so that darkness does not count for all
  return squared_difference / (reference_square + floor);
}

}  // namespace lumivec
