#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

#include "sim/collision/contacts.hpp"
#include "sim/parallel/loops.hpp"
#include "sim/system.hpp"

namespace drape {

/// What SelfContact and BodyContact have in common: vertices that go on straight ways in a step, and impulses that
/// change their velocities.
class ImpulseFilter : public MotionFilter {
 public:
  [[nodiscard]] bool converged() const override { return converged_; }

 protected:
  /// @param others  vertices that follow the cloth's: of infinite mass, as pins
  /// @param threads that share what is looked at of each vertex and each pair; impulses are one after another
  ImpulseFilter(const Cloth& cloth, std::size_t others, const Threads& threads)
      : threads_(for_so_many(threads, cloth.vertex_count())) {
    for (const double mass : cloth.masses) moving_.inverse_masses.push_back(1 / mass);
    for (const int pin : cloth.pins) moving_.inverse_masses[static_cast<std::size_t>(pin)] = 0;
    const std::size_t count = moving_.inverse_masses.size() + others;
    moving_.inverse_masses.resize(count, 0);
    moving_.velocities.resize(count, Point::Zero());
    x_.resize(count);
    target_.resize(count);
    found_for_.resize(count);
    changed_.resize(count);
  }

  [[nodiscard]] bool is_free(int vertex) const { return moving_.inverse_mass(vertex) > 0; }
  /// How far the vertices of a pair go in the step [m].
  [[nodiscard]] FourPoints moves(const FeaturePair& pair) const {
    FourPoints move;
    for (std::size_t i = 0; i < 4; ++i) move[i] = h_ * moving_.velocity(pair.vertices[i]);
    return move;
  }
  /// Whether any of a pair's vertices goes elsewhere than when impacts were last looked for.
  [[nodiscard]] bool changed(const FeaturePair& pair) const {
    return std::ranges::any_of(pair.vertices, [&](int i) { return changed_[static_cast<std::size_t>(i)] != 0; });
  }
  /// The target of every free vertex whose velocity has changed, of the first `count`; whether astray(i) is true of any
  /// of them.
  template <class Astray>
  bool change_targets(Eigen::Index count, Astray&& astray) {
    const auto change = [&](Eigen::Index first, Eigen::Index many) {
      bool any = false;
      for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(first + many); ++i) {
        const Point target = x_[i] + h_ * moving_.velocities[i];
        if (!is_free(static_cast<int>(i)) || target == target_[i]) continue;
        target_[i] = target;
        changed_[i] = 1;
        if (astray(i)) any = true;
      }
      return any;
    };
    return reduce(threads_, count, change, std::logical_or<>());
  }

  static constexpr Eigen::Index pairs_worth_dividing = 512;

  const Threads& threads_;
  double h_ = 0;
  MovingVertices moving_;
  std::vector<Point> x_, target_, found_for_;  // where vertices are, would go, and would have gone when last searched
  std::vector<char> changed_;                  // vertices whose targets changed since impacts were last looked for
  bool converged_ = true;
};

}  // namespace drape
