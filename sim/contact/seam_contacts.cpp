#include "sim/contact/seam_contacts.hpp"

#include <algorithm>

namespace drape {
namespace {

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

}  // namespace drape
