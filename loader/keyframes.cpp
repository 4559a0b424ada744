#include "loader/keyframes.h"

#include <algorithm>
#include <cmath>

namespace lumivec {
namespace {

using Numbers = std::vector<double>;

double length(const Numbers& q) {
  return std::hypot(std::hypot(q[0], q[1]), q[2], q[3]);
}

Numbers unit(Numbers q) {
  const double l = length(q);
  for (double& x : q) x /= l;
  return q;
}

// The shorter way between two unit quaternions, at constant speed.
Numbers slerp(const Numbers& a, const Numbers& b, double u) {
  double cosine = 0.0;
  for (std::size_t i = 0; i < 4; ++i) cosine += a[i] * b[i];
  const double sign = cosine < 0.0 ? -1.0 : 1.0;
  cosine = std::min(std::abs(cosine), 1.0);
  const double angle = std::acos(cosine);
  const double sine = std::sin(angle);
  double share_a = 1.0 - u;
  double share_b = u;
  constexpr double straight = 1e-6;  // radians: chord and arc agree to double precision, about
  if (angle > straight) {
    share_a = std::sin((1.0 - u) * angle) / sine;
    share_b = std::sin(u * angle) / sine;
  }
  Numbers q(4);
  for (std::size_t i = 0; i < 4; ++i) q[i] = share_a * a[i] + sign * share_b * b[i];
  return unit(std::move(q));
}

enum class Part : std::uint8_t { in_tangent, value, out_tangent };

class Keys {
 public:
  explicit Keys(const AnimationChannel& channel)
      : channel_(channel),
        spline_(channel.interpolation == Interpolation::cubic_spline),
        width_(numbers_per_key(channel)) {}

  Numbers part(std::size_t key, Part part) const {
    const std::size_t row = spline_ ? 3 * key + static_cast<std::size_t>(part) : key;
    const auto first = channel_.values.begin() + static_cast<std::ptrdiff_t>(row * width_);
    return {first, first + static_cast<std::ptrdiff_t>(width_)};
  }

  Numbers value(std::size_t key) const { return part(key, Part::value); }

 private:
  const AnimationChannel& channel_;
  bool spline_;
  std::size_t width_;
};

// Cubic Hermite between two keys that are duration seconds apart.
Numbers spline(const Keys& keys, std::size_t key, double u, double duration) {
  const Numbers from = keys.value(key);
  const Numbers leaving = keys.part(key, Part::out_tangent);
  const Numbers to = keys.value(key + 1);
  const Numbers arriving = keys.part(key + 1, Part::in_tangent);
  const double u2 = u * u;
  const double u3 = u2 * u;
  Numbers value(from.size());
  for (std::size_t i = 0; i < value.size(); ++i) {
    value[i] = (2.0 * u3 - 3.0 * u2 + 1.0) * from[i] + duration * (u3 - 2.0 * u2 + u) * leaving[i] +
               (3.0 * u2 - 2.0 * u3) * to[i] + duration * (u3 - u2) * arriving[i];
  }
  return value;
}

Numbers between(const AnimationChannel& channel, const Keys& keys, std::size_t key, double u) {
  const bool rotation = channel.target == AnimationTarget::rotation;
  if (channel.interpolation == Interpolation::cubic_spline) {
    const double duration = double(channel.times[key + 1]) - double(channel.times[key]);
    Numbers value = spline(keys, key, u, duration);
    // A spline may pass through no rotation at all; it stays at the key before for that moment.
    return rotation && !(length(value) > 0.0) ? keys.value(key) : value;
  }
  if (channel.interpolation == Interpolation::step) return keys.value(key);
  const Numbers from = keys.value(key);
  const Numbers to = keys.value(key + 1);
  if (rotation) return slerp(unit(from), unit(to), u);
  Numbers value(from.size());
  for (std::size_t i = 0; i < value.size(); ++i) value[i] = from[i] + u * (to[i] - from[i]);
  return value;
}

}  // namespace

std::size_t numbers_per_key(const AnimationChannel& channel) {
  const std::size_t rows = channel.interpolation == Interpolation::cubic_spline ? 3 : 1;
  return channel.values.size() / (rows * channel.times.size());
}

std::vector<double> value_at(const AnimationChannel& channel, double seconds) {
  const Keys keys(channel);
  const auto& times = channel.times;
  const auto next = std::upper_bound(times.begin(), times.end(), seconds,
                                     [](double t, float key) { return t < double(key); });
  Numbers value;
  if (next == times.begin()) {
    value = keys.value(0);
  } else if (next == times.end()) {
    value = keys.value(times.size() - 1);
  } else {
    const auto key = static_cast<std::size_t>(next - times.begin()) - 1;
    const double start = times[key];
    value = between(channel, keys, key, (seconds - start) / (double(*next) - start));
  }
  return channel.target == AnimationTarget::rotation ? unit(std::move(value)) : value;
}

}  // namespace lumivec
