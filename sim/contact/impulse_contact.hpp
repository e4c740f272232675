#pragma once

#include <memory>
#include <vector>

#include "sim/collision/rigid_zones.hpp"
#include "sim/contact/bounce.hpp"
#include "sim/contact/contact.hpp"
#include "sim/system.hpp"

namespace drape {

/// Contact of the explicit methods: impulses that change where a step leads, of the same contacts as ContactSolver's
/// and by the same law. A step that would go to y = x + h·v ends at
///   x' = y + Σ wᵢ/m·f,   f along the normal ≥ 0, n·d(x') ≥ distance, one of both an equation, |f across| ≤ µ·(n·f),
/// which is the minimum of ½(x' − y)ᵀM(x' − y) under the contacts. Projected Gauss-Seidel finds f [kg·m] contact by
/// contact; where it has moved vertices, the contacts are those of where they are now, until none is missed.
///
/// The velocities of the end get impulses of their own (Andersen 1983, for constraints that are equations): features
/// that bear a force do not approach, under the same law of friction. What separates features that were too near moves
/// them and gives no speed.
///
/// Restitution is Newton's law, see Bounce.
///
/// What still collides after a few rounds goes with the obstacle, or moves as a rigid body, see RigidZones; the step
/// counts as not converged then.
class ImpulseContact final : public MotionFilter {
 public:
  /// @param gravity on free parabolas, on which what bounces arrives and leaves [m/s²]
  ImpulseContact(std::vector<std::shared_ptr<ContactSource>> sources, const Cloth& cloth,
                 const Eigen::Vector3d& gravity);

  void begin(const State& state, double time) override;
  void apply(const Vertices& x, double time, double h, Vertices& v) override;
  bool adjust(const Vertices& x, double time, double h, Vertices& v) override;
  void finish(Vertices& v) override;
  [[nodiscard]] bool done() const override { return converged_; }

 private:
  /// A contact with what it has done to the step.
  struct Impulse {
    ContactConstraint contact;  ///< its force is f [kg·m]
    double compliance;          ///< Σ weights²/m of vertices that can move [1/kg]
    Bounce bounce;
  };
  void find();
  /// Solves from the contacts that are found, and finds more, until none is missed; has the vertices end there.
  void settle(Vertices& v);
  /// Returns true if the target lies where a contact forbids it.
  [[nodiscard]] bool violated() const;
  /// Starts from the unhindered target with the forces that are known.
  void apply_known();
  void push(const ContactConstraint& contact, const Eigen::Vector3d& change, Vertices& to) const;
  /// Passes over all contacts until none moves anything any further.
  void solve();
  /// By how much a contact's force changes that lacks so much along its normal and slips so far.
  [[nodiscard]] static Eigen::Vector3d change_of(const Impulse& impulse, double missing, const Eigen::Vector3d& slip);
  [[nodiscard]] bool any_collides() const;
  /// Returns true if the last solve has moved nothing so far that other contacts could follow.
  [[nodiscard]] bool stays_as_found() const;
  void hold();
  /// Lets the vertices of a contact go as its obstacle does. Returns whether any did not yet.
  bool hold_with_obstacle(const ContactConstraint& contact, std::vector<Point>& velocities);

  std::vector<std::shared_ptr<ContactSource>> sources_;
  std::vector<double> inverse_masses_;  // 0 on pins [1/kg]
  std::vector<char> free_;              // whether each vertex can move
  std::vector<Impulse> impulses_, before_;
  std::vector<ContactConstraint> found_, held_;
  RigidZones zones_;
  MovingVertices moving_;
  std::vector<Point> places_;
  const Vertices* x_ = nullptr;
  FreeFlight flight_;
  Vertices target_, before_target_;
  bool converged_ = true;
};

}  // namespace drape
