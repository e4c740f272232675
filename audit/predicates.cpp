#include "audit/predicates.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace drape::audit {
namespace {

struct Sum {
  double value, error;  // value + error is exact
};

/// Computes Knuth's exact sum, for summands of any magnitude.
Sum two_sum(double a, double b) {
  const double value = a + b;
  const double of_b = value - a;
  return {value, (a - (value - of_b)) + (b - of_b)};
}

/// Computes Dekker's exact sum.
/// @param large at least as large as `small` in magnitude
Sum fast_two_sum(double large, double small) {
  const double value = large + small;
  return {value, small - (value - large)};
}

Sum two_product(double a, double b) {
  const double value = a * b;
  return {value, std::fma(a, b, -value)};
}

}  // namespace

Expansion::Expansion(double value) {
  if (value != 0) parts_.push_back(value);
}

Expansion Expansion::difference(double a, double b) {
  const auto [value, error] = two_sum(a, -b);
  Expansion result(error);
  if (value != 0) result.parts_.push_back(value);
  return result;
}

int Expansion::sign() const {
  if (parts_.empty()) return 0;
  return parts_.back() > 0 ? 1 : -1;  // the largest part exceeds the sum of all others
}

double Expansion::estimate() const {
  double sum = 0;
  for (const double part : parts_) sum += part;
  return sum;
}

Expansion Expansion::half() const {
  Expansion result = *this;
  for (double& part : result.parts_) part *= 0.5;
  return result;
}

Expansion Expansion::operator-() const {
  Expansion result = *this;
  for (double& part : result.parts_) part = -part;
  return result;
}

Expansion Expansion::operator+(const Expansion& other) const {
  Expansion result = *this;
  for (const double part : other.parts_) result.add(part);
  result.compress();
  return result;
}

Expansion Expansion::operator*(const Expansion& other) const {
  Expansion result;
  for (const double a : parts_) {
    for (const double b : other.parts_) {
      const auto [value, error] = two_product(a, b);
      result.add(error);
      result.add(value);
    }
  }
  result.compress();
  return result;
}

/// Adds a double: Grow-Expansion (Shewchuk, figure 6), without zeros.
void Expansion::add(double value) {
  std::size_t kept = 0;
  for (const double part : parts_) {
    const auto [sum, error] = two_sum(value, part);
    value = sum;
    if (error != 0) parts_[kept++] = error;
  }
  parts_.resize(kept);
  if (value != 0) parts_.push_back(value);
}

/// Reduces the parts almost to the minimum: Compress (Shewchuk, figure 15).
void Expansion::compress() {
  if (parts_.size() < 2) return;
  std::size_t bottom = parts_.size() - 1;
  double carried = parts_.back();
  for (std::size_t i = parts_.size() - 1; i-- > 0;) {
    const auto [value, error] = fast_two_sum(carried, parts_[i]);
    carried = value;
    if (error != 0) {
      parts_[bottom--] = value;
      carried = error;
    }
  }
  parts_[bottom] = carried;
  std::size_t top = 0;
  for (std::size_t i = bottom + 1; i < parts_.size(); ++i) {
    const auto [value, error] = fast_two_sum(parts_[i], carried);
    carried = value;
    if (error != 0) parts_[top++] = error;
  }
  parts_[top++] = carried;
  parts_.resize(top);
}

double on_exact_grid(double coordinate) {
  if (!(std::abs(coordinate) < exact_range::largest)) {
    throw std::invalid_argument("a coordinate must be finite and below 1e30 m to be audited, found " +
                                std::to_string(coordinate));
  }
  // Added to 1.5·2⁵²·grid, a double is rounded to a multiple of the grid.
  constexpr double rounder = 0x1.8p52 * exact_range::grid;
  return std::abs(coordinate) < 0x1p52 * exact_range::grid ? (coordinate + rounder) - rounder : coordinate;
}

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

double square_distance(const Eigen::Vector3d& p, const std::array<Eigen::Vector3d, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const bool above = (b - a).cross(p - a).dot(normal) >= 0 && (c - b).cross(p - b).dot(normal) >= 0 &&
                     (a - c).cross(p - c).dot(normal) >= 0;
  if (above && normal.squaredNorm() > 0) return std::pow(normal.dot(p - a), 2) / normal.squaredNorm();
  double square = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d &from = triangle[i], along = triangle[(i + 1) % 3] - from;
    const double length = along.squaredNorm();
    const double s = length > 0 ? std::clamp((p - from).dot(along) / length, 0.0, 1.0) : 0;
    square = std::min(square, (from + s * along - p).squaredNorm());
  }
  return square;
}

}  // namespace drape::audit
