#include "audit/expansion.hpp"

#include <cmath>
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

}  // namespace drape::audit
