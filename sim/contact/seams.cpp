#include "sim/contact/seams.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace drape {
namespace {

using Index = std::size_t;

constexpr double time_rounding = 1e-12;  // relative error of the time at the end of a step

/// Returns the constraint of a tie between cloth vertices, without its law.
ContactConstraint constraint_of(const SeamTie& tie) {
  ContactConstraint contact;
  const bool at_vertex = tie.edge[0] == tie.edge[1];
  contact.count = at_vertex ? 2 : 3;
  contact.vertices = {tie.vertex, tie.edge[0], tie.edge[1], 0};
  contact.weights =
      at_vertex ? std::array<double, 4>{1, -1, 0, 0} : std::array<double, 4>{1, tie.share - 1, -tie.share, 0};
  contact.offset = contact.carried = Eigen::Vector3d::Zero();
  return contact;
}

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

void SeamContacts::begin(const Vertices& x, double /*start*/, double end) {
  x_ = &x;
  end_ = end;
}

void SeamContacts::find(const Vertices& target, int source, const std::vector<ContactConstraint>& held,
                        std::vector<ContactConstraint>& contacts) {
  for (std::size_t s = 0; s < cloth_.seams.size(); ++s) {
    const Seam& seam = cloth_.seams[s];
    const double open = end_ < seam.time * (1 - time_rounding) ? 1 - end_ / seam.time : 0;
    for (std::size_t k = 0; k < seam.ties.size(); ++k) {
      const double length = open * seam.ties[k].length;
      ContactConstraint contact = constraint_of(seam.ties[k]);
      contact.key = {.source = source, .kind = 0, .features = {static_cast<int>(s), static_cast<int>(k), -1, -1}};
      contact.start = contact.gather(*x_);
      contact.normal = Eigen::Vector3d::UnitZ();
      contact.sews = true;
      contact.welds = length == 0;
      if (!contact.welds) {
        contact.law = ContactLaw::length;
        const Eigen::Vector3d way = contact.gather(target);
        const bool pulls = std::ranges::binary_search(held, contact.key, {}, &ContactConstraint::key);
        if (!(way.norm() > length) && !pulls) continue;
        if (!way.isZero(0)) contact.normal = -way.stableNormalized();
        contact.distance = -length;
      }
      contacts.push_back(contact);
    }
  }
}

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
