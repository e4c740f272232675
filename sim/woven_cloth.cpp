#include "sim/woven_cloth.hpp"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

namespace drape {
namespace {

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

constexpr double most_deviation = 0.02;  // of C, as a fraction of its mean over all directions
constexpr double least_share = 1e-9;     // eigenvalue of directions that a mesh has, of the sum of all

/// Returns 1, cos 2θ, sin 2θ, cos 4θ and sin 4θ.
Vector5 harmonics(double angle) {
  return {1, std::cos(2 * angle), std::sin(2 * angle), std::cos(4 * angle), std::sin(4 * angle)};
}

/// Returns the harmonics of every spring's angle from the warp, as means over the triangles at it, weighed by area.
/// They are zero for a spring where the warp has no direction.
std::vector<Vector5> spring_harmonics(const Cloth& cloth, double warp_direction) {
  std::map<Edge, Vector5> sums;
  for (const Triangle& t : cloth.triangles) {
    const std::optional<double> warp = warp_angle(cloth, t, warp_direction);
    if (!warp) continue;
    const Eigen::RowVector3d origin = cloth.rest.row(t[0]);
    const Eigen::RowVector3d u = cloth.rest.row(t[1]) - origin, v = cloth.rest.row(t[2]) - origin, normal = u.cross(v);
    // Fronts may face either way in a mesh: angles are counted as seen from above.
    const double above = normal.z() < 0 ? -1 : 1, area = normal.norm() / 2;
    const Eigen::RowVector3d x = u.normalized(), y = normal.cross(u).normalized();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [i, j] = std::minmax(t[k], t[(k + 1) % 3]);
      const Eigen::RowVector3d side = cloth.rest.row(j) - cloth.rest.row(i);
      const double angle = above * (std::atan2(side.dot(y), side.dot(x)) - *warp);
      sums.try_emplace({i, j}, Vector5::Zero()).first->second += area * harmonics(angle);
    }
  }
  std::vector<Vector5> result;
  for (const Spring& spring : cloth.springs) {
    const auto sum = sums.find({spring.i, spring.j});
    result.push_back(sum == sums.end() ? Vector5::Zero() : Vector5(sum->second / sum->second[0]));
  }
  return result;
}

/// Returns the means of F and its products with the other harmonics, over all springs by area, that make up C.
Vector5 target(const WarpWeft& modulus) {
  const double mean = (modulus.warp + modulus.weft) / 2, middle = std::sqrt(modulus.warp * modulus.weft);
  return {3.0 / 4 * mean + middle / 4, 3.0 / 8 * (modulus.warp - modulus.weft), 0, 3.0 / 4 * (mean - middle), 0};
}

}  // namespace

std::optional<double> warp_angle(const Cloth& cloth, const Triangle& triangle, double angle) {
  const Eigen::RowVector3d u = cloth.rest.row(triangle[1]) - cloth.rest.row(triangle[0]);
  const Eigen::RowVector3d normal = u.cross(cloth.rest.row(triangle[2]) - cloth.rest.row(triangle[0]));
  const Eigen::RowVector3d warp(std::cos(angle), std::sin(angle), 0);
  const double along = warp.dot(u.normalized()), across = warp.dot(normal.cross(u).normalized());
  constexpr double least = 1e-6;
  if (!(normal.norm() > 0) || !(std::hypot(along, across) > least)) return std::nullopt;
  return std::atan2(across, along);
}

void stiffen_as_woven(const WarpWeft& modulus, Cloth& cloth) {
  stiffen_by_area(1, cloth);
  const std::vector<Vector5> harmonics = spring_harmonics(cloth, modulus.angle);
  Matrix5 means = Matrix5::Zero();
  double whole = 0;
  for (std::size_t s = 0; s < harmonics.size(); ++s) {
    const Spring& spring = cloth.springs[s];
    if (harmonics[s].isZero(0)) {
      throw std::invalid_argument(
          fmt::format("the warp has no direction at the edge between vertices {} and {}", spring.i, spring.j));
    }
    const double area = spring.stiffness * spring.rest_length * spring.rest_length;
    means += area * harmonics[s] * harmonics[s].transpose();
    whole += area;
  }
  means /= whole;
  // The smallest coefficients, as a mesh may have fewer directions than there are harmonics.
  const Eigen::SelfAdjointEigenSolver<Matrix5> parts(means);
  const Vector5 wanted = target(modulus);
  Vector5 coefficients = Vector5::Zero();
  for (int i = 0; i < 5; ++i) {
    if (parts.eigenvalues()[i] < least_share) continue;
    const Vector5 part = parts.eigenvectors().col(i);
    coefficients += part * (part.dot(wanted) / parts.eigenvalues()[i]);
  }
  const double deviation = (means * coefficients - wanted).norm() / wanted[0];
  if (deviation > most_deviation) {
    throw std::invalid_argument(fmt::format(
        "the mesh's edges run in too few directions for warp and weft: its stiffness would be wrong by {:.0f} "
        "%; a grid needs pattern \"alternating\" or \"x\", along its sides or at 45°",
        100 * deviation));
  }
  for (std::size_t s = 0; s < harmonics.size(); ++s) {
    const double share = coefficients.dot(harmonics[s]);
    if (!(share > 0)) {
      throw std::invalid_argument(fmt::format(
          "springs cannot represent {:g} N/m along the warp and {:g} N/m along the weft: the one between "
          "vertices {} and {} would push; expected a smaller ratio, up to 9 where edges run in all directions",
          modulus.warp, modulus.weft, cloth.springs[s].i, cloth.springs[s].j));
    }
    cloth.springs[s].stiffness *= share;
  }
}

void stiffen_by_direction(const WarpWeft& modulus, Cloth& cloth) {
  stiffen_by_area(1, cloth);
  const std::vector<Vector5> harmonics = spring_harmonics(cloth, modulus.angle);
  for (std::size_t s = 0; s < harmonics.size(); ++s) {
    const double along = (1 + harmonics[s][1]) / 2;  // cos²θ
    const double compliance = along / std::sqrt(modulus.warp) + (1 - along) / std::sqrt(modulus.weft);
    const bool directed = !harmonics[s].isZero(0);
    cloth.springs[s].stiffness *= directed ? 1 / (compliance * compliance) : std::sqrt(modulus.warp * modulus.weft);
  }
}

}  // namespace drape
