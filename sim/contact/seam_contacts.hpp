#pragma once

#include "drape/sim/cloth.hpp"
#include "sim/contact/contact.hpp"

namespace drape {

/// The ties of a cloth's seams. While a seam closes, a tie is a rope that becomes shorter. It pulls along its
/// direction, so it changes no angular momentum at the end of the step. In a closed seam a tie is a weld.
class SeamContacts final : public ContactSource {
 public:
  explicit SeamContacts(const Cloth& cloth) : cloth_(cloth) {}

  void begin(const Vertices& x, double start, double end) override;
  void find(const Vertices& target, int source, const std::vector<ContactConstraint>& held,
            std::vector<ContactConstraint>& contacts) override;

 private:
  const Cloth& cloth_;
  const Vertices* x_ = nullptr;
  double end_ = 0;  // of the step [s]
};

}  // namespace drape
