#include "sim/pressure/closed_pieces.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
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

}  // namespace drape
