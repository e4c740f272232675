#include "sim/pressure/gas_energy.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "sim/bending/bending_energy.hpp"

namespace drape {

namespace {

// Volume, as a fraction of the surface to the power of 3/2, below which a shape counts as flat.
constexpr double least_fullness = 1e-6;

/// Triangle beyond an edge.
struct Beyond {
  int triangle;
  bool same_side;  ///< true if both fronts are on the same side of the surface
  Edge edge;
};

/// Returns true if a triangle runs from the first vertex of the edge to the second.
bool runs_along(const Triangle& t, const Edge& edge) {
  for (std::size_t c = 0; c < 3; ++c) {
    if (t[c] == edge[0]) return t[(c + 1) % 3] == edge[1];
  }
  return false;
}

/// Returns the triangles beyond the edges of every triangle.
/// @throws std::invalid_argument, see closed_pieces()
std::vector<std::vector<Beyond>> neighbours(const std::vector<Triangle>& triangles) {
  const std::vector<EdgeSide> sides = edge_sides(triangles);
  if (sides.empty()) throw std::invalid_argument("expected a closed mesh, but the cloth has no triangles");
  std::vector<std::vector<Beyond>> result(triangles.size());
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    while (last < sides.size() && sides[last].edge == sides[first].edge) ++last;
    const Edge edge = sides[first].edge;
    if (last - first != 2) {
      throw std::invalid_argument(fmt::format(
          "expected closed pieces, where every edge has two triangles, but the edge of vertices {} and {} has {}",
          edge[0], edge[1], last - first));
    }
    const auto a = static_cast<std::size_t>(sides[first].triangle),
               b = static_cast<std::size_t>(sides[last - 1].triangle);
    const bool same = runs_along(triangles[a], edge) != runs_along(triangles[b], edge);
    result[a].push_back({sides[last - 1].triangle, same, edge});
    result[b].push_back({sides[first].triangle, same, edge});
  }
  return result;
}

void turn(Triangle& t) { std::swap(t[1], t[2]); }

/// Returns the piece with the first triangle, turned as that one; marks its triangles as seen: 1, or −1 if turned.
ClosedPiece collect(int first, const std::vector<Triangle>& triangles, const std::vector<std::vector<Beyond>>& beyond,
                    std::vector<int>& seen) {
  std::vector<int> members{first};
  seen[static_cast<std::size_t>(first)] = 1;
  for (std::size_t next = 0; next < members.size(); ++next) {
    const auto from = static_cast<std::size_t>(members[next]);
    for (const Beyond& to : beyond[from]) {
      const int side = to.same_side ? seen[from] : -seen[from];
      int& known = seen[static_cast<std::size_t>(to.triangle)];
      if (known == -side) {
        throw std::invalid_argument(fmt::format(
            "expected pieces with an inside, but the one at the edge of vertices {} and {} has only one side",
            to.edge[0], to.edge[1]));
      }
      if (known == 0) members.push_back(to.triangle);
      known = side;
    }
  }
  std::ranges::sort(members);
  ClosedPiece piece;
  for (const int t : members) {
    piece.triangles.push_back(triangles[static_cast<std::size_t>(t)]);
    if (seen[static_cast<std::size_t>(t)] < 0) turn(piece.triangles.back());
  }
  return piece;
}

/// Returns the sign of the volume, or 0 for a flat shape.
int orientation(const ClosedPiece& piece, const Vertices& x) {
  const double volume = enclosed_volume(piece.triangles, x);
  const double flattest = least_fullness * std::pow(surface_area(piece.triangles, x), 1.5);
  return std::abs(volume) <= flattest ? 0 : volume > 0 ? 1 : -1;
}

}  // namespace

std::vector<ClosedPiece> closed_pieces(const Cloth& cloth) {
  const auto beyond = neighbours(cloth.triangles);
  std::vector<int> seen(cloth.triangles.size(), 0);
  std::vector<ClosedPiece> pieces;
  for (std::size_t t = 0; t < seen.size(); ++t) {
    if (seen[t] != 0 || beyond[t].empty()) continue;
    pieces.push_back(collect(static_cast<int>(t), cloth.triangles, beyond, seen));
    int side = orientation(pieces.back(), cloth.rest);
    if (side == 0) side = orientation(pieces.back(), cloth.positions);
    if (side < 0) std::ranges::for_each(pieces.back().triangles, turn);
  }
  return pieces;
}

double enclosed_volume(const std::vector<Triangle>& triangles, const Vertices& x) {
  if (triangles.empty()) return 0;
  const Eigen::RowVector3d origin = x.row(triangles.front()[0]);
  double six = 0;
  for (const auto& [a, b, c] : triangles) {
    six += (x.row(a) - origin).dot((x.row(b) - origin).cross(x.row(c) - origin));
  }
  return six / 6;
}

double surface_area(const std::vector<Triangle>& triangles, const Vertices& x) {
  double twice = 0;
  for (const auto& [a, b, c] : triangles) twice += (x.row(b) - x.row(a)).cross(x.row(c) - x.row(a)).norm();
  return twice / 2;
}
namespace {

using Eigen::Matrix3d;
using Eigen::RowVector3d;

constexpr double most_stretch = 1.5;   // in every direction, up to which bounds hold
constexpr double volume_margin = 0.9;  // change of the initial volume of an ideal gas, up to which bounds hold

/// Returns the largest distance of a vertex from the mean of all [m].
double radius(const std::vector<int>& vertices, const Vertices& x) {
  RowVector3d centre = RowVector3d::Zero();
  for (const int i : vertices) centre += x.row(i) / static_cast<double>(vertices.size());
  double most = 0;
  for (const int i : vertices) most = std::max(most, (x.row(i) - centre).norm());
  return most;
}

/// Returns the sum of the squared sides of all triangles [m²].
double squared_sides(const std::vector<Triangle>& triangles, const Vertices& x) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    sum +=
        (x.row(a) - x.row(b)).squaredNorm() + (x.row(b) - x.row(c)).squaredNorm() + (x.row(c) - x.row(a)).squaredNorm();
  }
  return sum;
}

/// Returns the matrix of the cross product with a vector, [s]×.
Matrix3d cross_matrix(const RowVector3d& s) {
  Matrix3d matrix;
  matrix << 0, -s[2], s[1], s[2], 0, -s[0], -s[1], s[0], 0;
  return matrix;
}

}  // namespace

GasLaw::GasLaw(double amount, double outside, double most)
    : amount_(amount), outside_(outside), most_(most), reference_(most) {
  if (amount > 0 && outside > 0) reference_ = std::min(most, amount / outside);
}

double GasLaw::energy(double volume) const {
  if (!(volume <= most_) || (amount_ > 0 && !(volume > 0))) return std::numeric_limits<double>::infinity();
  const double growth = (volume - reference_) / reference_;
  return (amount_ == 0 ? 0 : -amount_ * std::log1p(growth)) + outside_ * reference_ * growth;
}

/// Hessian of all pieces. With a concavity of c it is N/V² ∇V∇Vᵀ − (1 + c)/2 p ∇²V + (1 − c)/2 B, which is exact for 1.
class GasEnergy::Hessian final : public EnergyHessian {
 public:
  explicit Hessian(const GasEnergy& energy) : energy_(energy) {
    std::size_t sides = 0, vertices = 0;
    for (const Piece& piece : energy.pieces_) {
      sides += piece.sides.size();
      vertices += piece.vertices.size();
    }
    blocks_.resize(sides);
    areas_.resize(vertices);
    slopes_.resize(energy.pieces_.size());
  }

  void linearise(const Vertices& x, double /*time*/, double concavity) override {
    Matrix3d* block = blocks_.data();
    RowVector3d* areas = areas_.data();
    for (std::size_t p = 0; p < slopes_.size(); ++p) {
      const Piece& piece = energy_.pieces_[p];
      const double volume = enclosed_volume(piece.triangles, x), pressure = piece.law.pressure(volume);
      slopes_[p] = piece.law.slope(volume);
      RowVector3d centre = RowVector3d::Zero();
      for (const int i : piece.vertices) centre += x.row(i);
      centre /= static_cast<double>(piece.vertices.size());
      for (const Side& side : piece.sides) *block++ = coupling(side, x, centre, pressure, concavity);
      find_areas(piece, x, areas);
      areas += piece.vertices.size();
    }
  }

  void add_product(const Vertices& vector, Vertices& product) const override {
    const Matrix3d* block = blocks_.data();
    const RowVector3d* areas = areas_.data();
    for (std::size_t p = 0; p < slopes_.size(); ++p) {
      const Piece& piece = energy_.pieces_[p];
      for (const Side& side : piece.sides) {
        const Matrix3d& k = *block++;
        const Eigen::Vector3d vi = vector.row(side.i).transpose(), vj = vector.row(side.j).transpose();
        const Matrix3d own = (k + k.transpose()) / 2;
        product.row(side.i) += (own * vi - k * vj).transpose();
        product.row(side.j) += (own * vj - k.transpose() * vi).transpose();
      }
      if (slopes_[p] > 0) {
        double along = 0;
        for (std::size_t i = 0; i < piece.vertices.size(); ++i) along += areas[i].dot(vector.row(piece.vertices[i]));
        for (std::size_t i = 0; i < piece.vertices.size(); ++i) {
          product.row(piece.vertices[i]) += slopes_[p] * along * areas[i];
        }
      }
      areas += piece.vertices.size();
    }
  }

  void add_blocks(HessianBlocks& blocks) const override {
    blocks.pairs.insert(blocks.pairs.end(), blocks_.begin(), blocks_.end());
    const RowVector3d* areas = areas_.data();
    for (std::size_t p = 0; p < slopes_.size(); ++p) {
      const std::vector<int>& vertices = energy_.pieces_[p].vertices;
      if (slopes_[p] > 0) blocks.products.push_back({vertices, std::span(areas, vertices.size()), slopes_[p]});
      areas += vertices.size();
    }
  }

 private:
  /// Returns the block K of an edge, see HessianBlocks.
  static Matrix3d coupling(const Side& side, const Vertices& x, const RowVector3d& centre, double pressure,
                           double concavity) {
    Matrix3d block = (1 + concavity) / 2 * pressure / 6 * cross_matrix(x.row(side.l) - x.row(side.k));
    const double share = (1 - concavity) / 2 * std::abs(pressure) / std::sqrt(3.0);
    for (const int third : {side.k, side.l}) {
      const RowVector3d arm = (x.row(side.i) + x.row(side.j) + x.row(third)) / 3 - centre;
      const double length = arm.norm();
      if (length > 0) block += share * (length * Matrix3d::Identity() - arm.transpose() * arm / length);
    }
    return block;
  }

  /// Computes ∇V at the vertices of a piece [m²].
  static void find_areas(const Piece& piece, const Vertices& x, RowVector3d* areas) {
    std::fill(areas, areas + piece.vertices.size(), RowVector3d::Zero());
    for (std::size_t t = 0; t < piece.triangles.size(); ++t) {
      const auto& [a, b, c] = piece.triangles[t];
      const RowVector3d third = (x.row(b) - x.row(a)).cross(x.row(c) - x.row(a)) / 6;
      for (const int at : piece.positions[t]) areas[at] += third;
    }
  }

  const GasEnergy& energy_;
  std::vector<Matrix3d> blocks_;    // per side of every piece [N/m]
  std::vector<RowVector3d> areas_;  // ∇V per vertex of every piece [m²]
  std::vector<double> slopes_;      // N/V² per piece [Pa/m³]
};

GasEnergy::GasEnergy(const Cloth& cloth, std::span<const ClosedPiece> pieces, std::span<const GasLaw> laws) {
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    pieces_.push_back({.triangles = pieces[p].triangles,
                       .sides = {},
                       .vertices = {},
                       .positions = {},
                       .law = laws[p],
                       .stiffness = 0});
    Piece& piece = pieces_.back();
    for (const Triangle& t : piece.triangles) piece.vertices.insert(piece.vertices.end(), t.begin(), t.end());
    std::ranges::sort(piece.vertices);
    piece.vertices.erase(std::unique(piece.vertices.begin(), piece.vertices.end()), piece.vertices.end());
    for (const Triangle& t : piece.triangles) {
      std::array<int, 3>& places = piece.positions.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) {
        places[c] = static_cast<int>(std::ranges::lower_bound(piece.vertices, t[c]) - piece.vertices.begin());
      }
    }
    const std::vector<EdgeSide> sides = edge_sides(piece.triangles);
    for (std::size_t s = 0; s + 1 < sides.size(); s += 2) {
      const auto& [i, j] = sides[s].edge;
      const Triangle& t = piece.triangles[static_cast<std::size_t>(sides[s].triangle)];
      const bool along = (t[0] == i && t[1] == j) || (t[1] == i && t[2] == j) || (t[2] == i && t[0] == j);
      const int first = sides[s].opposite, second = sides[s + 1].opposite;
      piece.sides.push_back({i, j, along ? first : second, along ? second : first});
    }
    piece.stiffness = stiffness_bound(piece, cloth);
  }
}

double GasEnergy::largest_volume(const ClosedPiece& piece, const Cloth& cloth) {
  const double area =
      most_stretch * most_stretch *
      std::max(surface_area(piece.triangles, cloth.rest), surface_area(piece.triangles, cloth.positions));
  return std::pow(area, 1.5) / (6 * std::sqrt(std::numbers::pi));
}

double GasEnergy::stiffness_bound(const Piece& piece, const Cloth& cloth) {
  // |∇V·u| ≤ R/(4√3) √(Σ squared sides) √(Σ |d|²) bounds the first part of the Hessian in the same way as ∇²V.
  const double size = std::max(radius(piece.vertices, cloth.rest), radius(piece.vertices, cloth.positions));
  const double initial = enclosed_volume(piece.triangles, cloth.positions);
  const double smallest = volume_margin * initial, largest = initial / volume_margin;
  const double push = std::max(std::abs(piece.law.pressure(smallest)), std::abs(piece.law.pressure(largest)));
  const double squares =
      std::max(squared_sides(piece.triangles, cloth.rest), squared_sides(piece.triangles, cloth.positions));
  return 2 * push * most_stretch * size / std::sqrt(3.0) + piece.law.slope(smallest) * size * size * squares / 24;
}

double GasEnergy::add_gradient(const Vertices& x, double /*time*/, Vertices& gradient) const {
  double energy = 0;
  for (const Piece& piece : pieces_) {
    const double volume = enclosed_volume(piece.triangles, x), push = piece.law.pressure(volume) / 6;
    energy += piece.law.energy(volume);
    for (const auto& [a, b, c] : piece.triangles) {
      const RowVector3d force = push * (x.row(b) - x.row(a)).cross(x.row(c) - x.row(a));
      for (const int corner : {a, b, c}) gradient.row(corner) -= force;
    }
  }
  return energy;
}

void GasEnergy::add_bound(StiffnessBound& bound) const {
  for (const Piece& piece : pieces_) {
    for (const Side& side : piece.sides) {
      bound.pairs.push_back({.i = side.i, .j = side.j, .rest_length = 0, .stiffness = piece.stiffness});
    }
  }
}

std::unique_ptr<EnergyHessian> GasEnergy::make_hessian() const { return std::make_unique<Hessian>(*this); }

}  // namespace drape
