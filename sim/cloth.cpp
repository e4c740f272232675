#include "drape/sim/cloth.hpp"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace drape {

Cloth make_cloth(const Mesh& start, const Mesh& rest, double mass, double stiffness, std::vector<int> pins) {
  if (start.positions.rows() != rest.positions.rows() || start.triangles != rest.triangles) {
    throw std::invalid_argument("the starting mesh and the rest mesh must have the same vertices and triangles");
  }
  const auto is_vertex = [&](int i) { return i >= 0 && i < rest.positions.rows(); };
  const auto is_whole = [&](const Triangle& triangle) { return std::ranges::all_of(triangle, is_vertex); };
  if (!std::ranges::all_of(rest.triangles, is_whole)) {
    throw std::invalid_argument("a triangle has a vertex that the mesh does not have");
  }
  Cloth cloth;
  cloth.positions = start.positions;
  cloth.velocities = Vertices::Zero(start.positions.rows(), 3);
  cloth.rest = rest.positions;
  cloth.triangles = start.triangles;
  cloth.masses.setConstant(start.positions.rows(), mass / static_cast<double>(start.positions.rows()));

  const std::vector<Edge> edges = unique_edges(rest.triangles);
  cloth.springs.reserve(edges.size());
  for (const auto& [i, j] : edges) {
    const double length = (rest.positions.row(i) - rest.positions.row(j)).norm();
    cloth.springs.push_back({.i = i, .j = j, .rest_length = length, .stiffness = stiffness});
  }

  std::sort(pins.begin(), pins.end());
  pins.erase(std::unique(pins.begin(), pins.end()), pins.end());
  if (!pins.empty() && (pins.front() < 0 || pins.back() >= cloth.vertex_count())) {
    throw std::invalid_argument("a pin is not a vertex of the cloth");
  }
  cloth.pins = std::move(pins);
  return cloth;
}

namespace {

/// Appends the rows of `more` to a matrix.
template <class Matrix>
void append_rows(const Matrix& more, Matrix& rows) {
  const Eigen::Index before = rows.rows();
  rows.conservativeResize(before + more.rows(), rows.cols());
  rows.bottomRows(more.rows()) = more;
}

}  // namespace

void append(const std::string& name, const Cloth& one, Cloth& all) {
  const int first = all.vertex_count(), first_triangle = static_cast<int>(all.triangles.size());
  all.pieces.push_back({.name = name,
                        .first_vertex = first,
                        .vertex_count = one.vertex_count(),
                        .first_triangle = first_triangle,
                        .triangle_count = static_cast<int>(one.triangles.size())});
  append_rows(one.positions, all.positions);
  append_rows(one.velocities, all.velocities);
  append_rows(one.rest, all.rest);
  append_rows(one.masses, all.masses);
  for (Triangle triangle : one.triangles) {
    for (int& vertex : triangle) vertex += first;
    all.triangles.push_back(triangle);
  }
  for (Spring spring : one.springs) {
    spring.i += first;
    spring.j += first;
    all.springs.push_back(spring);
  }
  for (const int pin : one.pins) all.pins.push_back(first + pin);
}

const ClothPiece* find_piece(const Cloth& cloth, std::string_view name) {
  const auto found = std::ranges::find(cloth.pieces, name, &ClothPiece::name);
  return found == cloth.pieces.end() ? nullptr : &*found;
}

std::vector<int> pieces_of_vertices(const Cloth& cloth) {
  if (cloth.pieces.size() < 2) return {};
  std::vector<int> numbers(static_cast<std::size_t>(cloth.vertex_count()), 0);
  for (std::size_t k = 0; k < cloth.pieces.size(); ++k) {
    const auto first = numbers.begin() + cloth.pieces[k].first_vertex;
    std::fill_n(first, cloth.pieces[k].vertex_count, static_cast<int>(k));
  }
  return numbers;
}

Cloth only_piece(const Cloth& cloth, const ClothPiece& piece) {
  Cloth part = cloth;
  const auto first = cloth.triangles.begin() + piece.first_triangle;
  part.triangles.assign(first, first + piece.triangle_count);
  std::erase_if(part.springs, [&](const Spring& spring) { return !piece.has(spring.i); });
  return part;
}

double size_of(const Cloth& cloth) {
  const Vertices& x = cloth.positions;
  double size = (x.colwise().maxCoeff() - x.colwise().minCoeff()).stableNorm();
  for (const Spring& spring : cloth.springs) size = std::max(size, spring.rest_length);
  return size;
}

namespace {

double area_of(const Triangle& t, const Vertices& x) {
  const Eigen::RowVector3d p = x.row(t[1]) - x.row(t[0]), q = x.row(t[2]) - x.row(t[0]);
  return p.cross(q).norm() / 2;
}

}  // namespace

void share_mass_by_area(double density, Cloth& cloth) {
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(cloth.vertex_count());
  std::vector<char> used(static_cast<std::size_t>(cloth.vertex_count()), 0);
  for (const Triangle& t : cloth.triangles) {
    const double third = density * area_of(t, cloth.rest) / 3;
    for (const int vertex : t) {
      masses[vertex] += third;
      used[static_cast<std::size_t>(vertex)] = 1;
    }
  }
  const double mean = masses.sum() / static_cast<double>(std::ranges::count(used, 1));
  for (Eigen::Index i = 0; i < masses.size(); ++i) {
    if (used[static_cast<std::size_t>(i)] == 0) masses[i] = mean;
    if (!(masses[i] > 0)) {
      throw std::invalid_argument("no triangle at vertex " + std::to_string(i) +
                                  " has an area, so it has no mass by area");
    }
  }
  cloth.masses = std::move(masses);
}

void stiffen_by_area(double modulus, Cloth& cloth) {
  std::map<Edge, double> areas;  // of the triangles at each edge
  for (const Triangle& t : cloth.triangles) {
    const double area = area_of(t, cloth.rest);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [i, j] = std::minmax(t[k], t[(k + 1) % 3]);
      if (i != j) areas[{i, j}] += area;
    }
  }
  for (Spring& spring : cloth.springs) {
    const double area = areas.at({spring.i, spring.j}), squared = spring.rest_length * spring.rest_length;
    if (!(area > 0) || !(squared > 0)) {
      throw std::invalid_argument("no triangle at the edge between vertices " + std::to_string(spring.i) + " and " +
                                  std::to_string(spring.j) + " has an area, so its spring has no stiffness by area");
    }
    spring.stiffness = modulus * area / squared;
  }
}

std::span<const Fabric> fabrics() {
  static constexpr Fabric all[] = {
      {"canvas", "cotton duck, 10 oz", 0.340, 9800, 150e-6, false},
      {"cotton", "shirting, plain weave", 0.120, 4900, 7e-6, false},
      {"denim", "11oz Black Denim", 0.324, {2028, 411}, {64.2e-6, 97.0e-6}},
      {"dots", "White Dots on Black", 0.128, {4055, 4004}, {51.7e-6, 31.3e-6}},
      {"interlock", "Gray Interlock", 0.187, {69.0, 33.2}, {23.2e-6, 14.3e-6}},
      {"jet-set", "Tango Red Jet Set", 0.113, {343, 86.1}, {14.3e-6, 20.3e-6}},
      {"paper", "printing paper, 0.11 mm", 0.080, 319000, 353e-6, false},
      {"ponte-roma", "Camel Ponte Roma", 0.284, {88.1, 62.3}, {36.3e-6, 37.2e-6}},
      {"rib-knit", "Ivory Rib Knit", 0.276, {130, 85.7}, {46.2e-6, 32.2e-6}},
      {"ribbon", "Pink Ribbon Brown", 0.228, {490, 303}, {117e-6, 59.8e-6}},
      {"silk", "habotai, plain weave", 0.055, 3300, 2.5e-6, false},
      {"sweat", "Navy Sparkle Sweat", 0.224, {6.54, 25.0}, {59.5e-6, 45.6e-6}},
      {"swim", "White Swim Solid", 0.204, {209, 95.9}, {60.2e-6, 51.0e-6}},
      {"target", "Royal Target", 0.220, {4070, 4033}, {125.4e-6, 125.4e-6}},
      {"wool", "suiting, plain weave", 0.230, 2500, 10e-6, false},
  };
  return all;
}

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
