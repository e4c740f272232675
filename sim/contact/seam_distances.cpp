#include "sim/contact/seam_distances.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace drape {
namespace {

using Index = std::size_t;

/// Returns the distance of a vertex from a side of a seam in the rest shape [m].
double distance_from(const Cloth& cloth, const std::vector<int>& side, int vertex) {
  double least = std::numeric_limits<double>::infinity();
  const Eigen::RowVector3d x = cloth.rest.row(vertex);
  for (Index k = 0; k < side.size(); ++k) {
    const Eigen::RowVector3d from = cloth.rest.row(side[k]),
                             way = cloth.rest.row(side[std::min(k + 1, side.size() - 1)]) - from;
    const double squared = way.squaredNorm();
    const double share = squared > 0 ? std::clamp((x - from).dot(way) / squared, 0.0, 1.0) : 0.0;
    least = std::min(least, (x - from - share * way).norm());
  }
  return least;
}

bool same_piece(const Cloth& cloth, int i, int j) {
  return std::ranges::all_of(cloth.pieces, [&](const ClothPiece& piece) { return piece.has(i) == piece.has(j); });
}

}  // namespace

SeamDistances::SeamDistances(const Cloth& cloth, double most) {
  if (cloth.seams.empty()) return;
  near_.resize(static_cast<Index>(cloth.vertex_count()));
  for (Index k = 0; k < 2 * cloth.seams.size(); ++k) {
    const std::vector<int>& side = cloth.seams[k / 2].sides[k % 2];
    if (side.empty()) continue;
    for (int vertex = 0; vertex < cloth.vertex_count(); ++vertex) {
      if (!same_piece(cloth, vertex, side.front())) continue;
      const double distance = distance_from(cloth, side, vertex);
      if (distance <= most) near_[static_cast<Index>(vertex)].push_back({k, distance});
    }
  }
}

double SeamDistances::across(const FeaturePair& pair) const {
  double least = std::numeric_limits<double>::infinity();
  if (near_.empty()) return least;
  const std::span<const int> all(pair.vertices);
  const Index of_first = pair.feature == Feature::vertex_triangle ? 1 : 2;
  for (const int i : all.first(of_first)) {
    for (const int j : all.subspan(of_first)) {
      for (const Near& a : near_[static_cast<Index>(i)]) {
        for (const Near& b : near_[static_cast<Index>(j)]) {
          if (a.side == (b.side ^ 1U)) least = std::min(least, a.distance + b.distance);
        }
      }
    }
  }
  return least;
}

}  // namespace drape
