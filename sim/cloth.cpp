#include "drape/sim/cloth.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

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
  for (const Triangle& t : cloth.triangles) {
    const double third = density * area_of(t, cloth.rest) / 3;
    for (const int vertex : t) masses[vertex] += third;
  }
  for (Eigen::Index i = 0; i < masses.size(); ++i) {
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

}  // namespace drape
