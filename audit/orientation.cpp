#include "audit/orientation.hpp"

#include <array>
#include <cmath>

#include "audit/expansion.hpp"

namespace drape::audit {
namespace {

constexpr double filter = (7 + 56 * 0x1p-53) * 0x1p-53;  // Shewchuk 1997, section 4.3: o3derrboundA

int exact_orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                      const Eigen::Vector3d& d) {
  std::array<std::array<Expansion, 3>, 3> row;
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    row[0][k] = Expansion::difference(b[axis], a[axis]);
    row[1][k] = Expansion::difference(c[axis], a[axis]);
    row[2][k] = Expansion::difference(d[axis], a[axis]);
  }
  const auto minor = [&](std::size_t i, std::size_t j) { return row[0][i] * row[1][j] - row[0][j] * row[1][i]; };
  return (minor(1, 2) * row[2][0] + minor(2, 0) * row[2][1] + minor(0, 1) * row[2][2]).sign();
}

}  // namespace

int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                const Eigen::Vector3d& d) {
  const Eigen::Vector3d u = b - a, v = c - a, w = d - a;
  const double uv12 = u[1] * v[2], uv21 = u[2] * v[1];
  const double uv20 = u[2] * v[0], uv02 = u[0] * v[2];
  const double uv01 = u[0] * v[1], uv10 = u[1] * v[0];
  const double volume = w[0] * (uv12 - uv21) + w[1] * (uv20 - uv02) + w[2] * (uv01 - uv10);
  const double permanent = (std::abs(uv12) + std::abs(uv21)) * std::abs(w[0]) +
                           (std::abs(uv20) + std::abs(uv02)) * std::abs(w[1]) +
                           (std::abs(uv01) + std::abs(uv10)) * std::abs(w[2]);
  const double error = filter * permanent;
  if (volume > error) return 1;
  if (volume < -error) return -1;
  return exact_orientation(a, b, c, d);
}

}  // namespace drape::audit
