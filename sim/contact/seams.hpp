#pragma once

#include <vector>

#include "drape/sim/cloth.hpp"
#include "sim/collision/candidates.hpp"
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
  [[nodiscard]] bool separates() const override { return true; }  // a seam may begin open

 private:
  const Cloth& cloth_;
  const Vertices* x_ = nullptr;
  double end_ = 0;  // of the step [s]
};

/// Distances along the cloth across its seams, from vertices near these.
class SeamDistances {
 public:
  /// @param most longest distance that counts [m]
  SeamDistances(const Cloth& cloth, double most);

  /// Returns the distance of two features across a seam: the sum of their distances from its two sides in the rest
  /// shape. Zero if both are on the seam, infinite if it exceeds the longest [m].
  [[nodiscard]] double across(const FeaturePair& pair) const;

 private:
  /// A side of a seam near a vertex.
  struct Near {
    std::size_t side;  // 2·seam + 0 or 1
    double distance;   // [m]
  };

  std::vector<std::vector<Near>> near_;  // per vertex; empty without seams
};

}  // namespace drape
