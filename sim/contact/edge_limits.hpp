#pragma once

#include <vector>

#include "drape/sim/cloth.hpp"
#include "drape/sim/effects/strain_limit.hpp"
#include "sim/contact/contact.hpp"

namespace drape {

/// A StrainLimit as constraints of an implicit step: an edge that would end beyond a limit is a contact of its ends, of
/// the law ContactLaw::length. The tension of the edge is the contact's force.
class EdgeLimits final : public ContactSource {
 public:
  EdgeLimits(const StrainLimit& limits, const Cloth& cloth);

  void begin(const Vertices& x, double start, double end) override;
  void find(const Vertices& target, int source, const std::vector<ContactConstraint>& held,
            std::vector<ContactConstraint>& contacts) override;

 private:
  struct Edge {
    int spring;  // number in the cloth
    int i, j;
    double shortest, longest;  // [m]
  };

  double tolerance_;  // relative
  std::vector<Edge> edges_;
  const Vertices* x_ = nullptr;  // at the start of the step
};

}  // namespace drape
