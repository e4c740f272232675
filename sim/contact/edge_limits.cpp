#include "sim/contact/edge_limits.hpp"

#include <cmath>

namespace drape {
namespace {

using Index = std::size_t;

/// Limits of an edge, as part of a contact's key.
enum Limit : int { none = -1, upper, lower };

}  // namespace

EdgeLimits::EdgeLimits(const StrainLimit& limits, const Cloth& cloth) : tolerance_(limits.tolerance) {
  const std::vector<double> inverse = inverse_masses(cloth);
  const ClothPiece* const piece = find_piece(cloth, limits.cloth);
  for (Index k = 0; k < cloth.springs.size(); ++k) {
    const Spring& s = cloth.springs[k];
    if (piece != nullptr && !piece->has(s.i)) continue;
    const bool moves = inverse[static_cast<Index>(s.i)] + inverse[static_cast<Index>(s.j)] > 0;
    if (!moves || !(s.rest_length > 0)) continue;
    edges_.push_back({.spring = static_cast<int>(k),
                      .i = s.i,
                      .j = s.j,
                      .shortest = limits.min_stretch.value_or(0) * s.rest_length,
                      .longest = limits.max_stretch * s.rest_length});
  }
}

void EdgeLimits::begin(const Vertices& x, double /*start*/, double /*end*/) { x_ = &x; }

void EdgeLimits::find(const Vertices& target, int source, const std::vector<ContactConstraint>& held,
                      std::vector<ContactConstraint>& contacts) {
  auto known = held.begin();
  for (const Edge& edge : edges_) {
    const Eigen::Vector3d way = (target.row(edge.i) - target.row(edge.j)).transpose();
    const double squared = way.squaredNorm();
    int limit = squared > edge.longest * edge.longest ? upper : squared < edge.shortest * edge.shortest ? lower : none;
    while (known != held.end() && known->key.features[0] < edge.spring) ++known;
    if (limit == none && known != held.end() && known->key.features[0] == edge.spring) limit = known->key.features[1];
    if (limit == none) continue;
    ContactConstraint contact;
    contact.key = {.source = source, .kind = 0, .features = {edge.spring, limit, -1, -1}};
    contact.law = ContactLaw::length;
    contact.count = 2;
    contact.vertices = {edge.i, edge.j, 0, 0};
    contact.weights = {1, -1, 0, 0};
    contact.start = contact.gather(*x_);
    const Eigen::Vector3d along = squared > 0 ? way.stableNormalized() : contact.start.stableNormalized();
    contact.normal = limit == upper ? Eigen::Vector3d(-along) : along;
    contact.distance = limit == upper ? -edge.longest : edge.shortest;
    contact.most_open = tolerance_ * std::abs(contact.distance);
    contacts.push_back(contact);
  }
}

}  // namespace drape
