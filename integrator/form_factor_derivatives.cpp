#include "integrator/form_factor_derivatives.h"

#include <cmath>
#include <utility>

namespace lumivec {

// The term is N ψ / 2 with N = (a × b)·z, c = a·b, q = |a × b|², and ψ = atan2(√q, c) / √q. If the
// point moves by x, then a and b move by −x, and with e = b − a
//   N' = (−e_y, e_x), N'' = 0;  c' = −(a + b), c'' = 2 I;
//   q' = −2 e × (a × b), q'' = 2 (|e|² I − e eᵀ)   (their x and y parts),
//   ψ_c = −1 / P, ψ_q = (c / P − ψ) / 2q, ψ_cc = 2c / P², ψ_cq = 1 / P²,
//   ψ_qq = (−c / P² − 3 ψ_q) / 2q, with P = c² + q = |a|² |b|².
PlaneDerivatives edge_form_factor(const V3d& a, const V3d& b) {
  PlaneDerivatives d;
  const V3d cross = a.cross(b), e = b - a;
  const double c = a.dot(b), q = cross.length2(), p = c * c + q;
  constexpr double degenerate = 1e-14;  // squared sine
  constexpr double narrow = 1e-4;       // likewise; below it differences lose too many digits
  if (!(p > 0.0) || (c <= 0.0 && q < degenerate * p) || !std::isfinite(p)) return d;
  double psi, psi_q, psi_qq;
  if (c > 0.0 && q < narrow * p) {  // the series of atan
    const double c2 = c * c, t = q / c2;
    psi = (1.0 + t * (-1.0 / 3 + t * (1.0 / 5 - t / 7))) / c;
    psi_q = (-1.0 / 3 + t * (2.0 / 5 - t * 3.0 / 7)) / (c * c2);
    psi_qq = (2.0 / 5 - t * 6.0 / 7) / (c * c2 * c2);
  } else {
    const double s = std::sqrt(q);
    psi = std::atan2(s, c) / s;
    psi_q = (c / p - psi) / (2.0 * q);
    psi_qq = (-c / (p * p) - 3.0 * psi_q) / (2.0 * q);
  }
  const double psi_c = -1.0 / p, psi_cc = 2.0 * c / (p * p), psi_cq = 1.0 / (p * p);
  const double n = cross.z, nx = -e.y, ny = e.x;
  const double cx = -(a.x + b.x), cy = -(a.y + b.y);
  const V3d turn = e.cross(cross);
  const double qx = -2.0 * turn.x, qy = -2.0 * turn.y;
  const double e2 = e.length2();
  const double px = psi_c * cx + psi_q * qx, py = psi_c * cy + psi_q * qy;
  const auto second = [&](double ci, double cj, double qi, double qj, double cij, double qij) {
    return psi_c * cij + psi_q * qij + psi_cc * ci * cj + psi_cq * (ci * qj + cj * qi) +
           psi_qq * qi * qj;
  };
  d.value = 0.5 * n * psi;
  d.gx = 0.5 * (nx * psi + n * px);
  d.gy = 0.5 * (ny * psi + n * py);
  d.hxx = 0.5 * (2.0 * nx * px + n * second(cx, cx, qx, qx, 2.0, 2.0 * (e2 - e.x * e.x)));
  d.hyy = 0.5 * (2.0 * ny * py + n * second(cy, cy, qy, qy, 2.0, 2.0 * (e2 - e.y * e.y)));
  d.hxy = 0.5 * (nx * py + ny * px + n * second(cx, cy, qx, qy, 0.0, -2.0 * e.x * e.y));
  return d;
}

Curvature principal_curvature(const PlaneDerivatives& d) {
  const double middle = 0.5 * (d.hxx + d.hyy), half = 0.5 * (d.hxx - d.hyy);
  const double spread = std::hypot(half, d.hxy);
  double first = middle + spread, second = middle - spread;
  // The eigenvector of the larger eigenvalue, at half the angle of (half, hxy).
  const double angle = 0.5 * std::atan2(d.hxy, half);
  double x = std::cos(angle), y = std::sin(angle);
  if (std::abs(second) > std::abs(first)) {
    std::swap(first, second);
    std::swap(x, y);
    x = -x;
  }
  return {std::abs(first), std::abs(second), x, y};
}

}  // namespace lumivec
