#pragma once

#include <array>
#include <memory>
#include <vector>

#include "sim/collision/distance.hpp"
#include "sim/contact/contact.hpp"
#include "sim/system.hpp"

namespace drape {

/// Moves groups of vertices as rigid bodies for one step, used when impulses cannot resolve a pile of collisions
/// (Provot 1997; Bridson, Fedkiw and Anderson 2002, section 7.5; Harmon et al. 2008). Groups that share vertices form
/// one zone. A zone keeps the linear and angular momentum of its vertices: v = v̄ + ω × (x − x̄). On the path x + t·v no
/// two of its points approach each other, since I + t·[ω]× shortens no vector. So there is no collision inside a zone.
/// A zone with pins moves with the first of these.
/// @param all            joins all groups into one zone
/// @param x              positions of all vertices [m]
/// @param inverse_masses of all vertices; 0 for a pin [1/kg]
/// @param velocities     of all vertices; changes those of free vertices in groups [m/s]
void move_rigidly(const std::vector<std::array<int, 4>>& groups, bool all, const std::vector<Point>& x,
                  const std::vector<double>& inverse_masses, std::vector<Point>& velocities);

/// Contact for explicit methods, by impulses that change the positions at the end of a step. Contacts and contact law
/// are those of ContactSolver. A step that would reach y = x + h·v ends at
///   x' = y + Σ wᵢ/m·f,   0 ≤ n·f ⊥ n·d(x') − distance ≥ 0, |f across| ≤ µ·(n·f),
/// the minimum of ½(x' − y)ᵀM(x' − y) under the contacts. Projected Gauss-Seidel finds f [kg·m] one contact at a time.
/// If this moves vertices, contacts are found again at the new positions until none is missed. The start of the step
/// meets all contacts (ContactConstraint::possible_distance). Otherwise several could exclude every motion, and their
/// forces would grow without limit. A projection onto a convex set that holds x moves nothing further from x, so
/// contacts at rest take kinetic energy only.
///
/// End velocities get separate impulses (Andersen 1983, for equality constraints). Features that bear a force do not
/// approach, under the same friction law. Separating features that were too near moves them but adds no speed.
///
/// Restitution follows Newton's law, see Bounce.
///
/// After a few rounds, vertices that still collide move with the obstacle or as a rigid body, see move_rigidly. The
/// step then counts as not converged. So does one whose passes end at their limit, if a contact still misses a
/// hundredth of the contact distance.
class ImpulseContact final : public MotionFilter {
 public:
  /// @param system with its contacts, springs and gravity
  explicit ImpulseContact(const System& system);

  void begin(const State& state, double time) override;
  void apply(const Vertices& x, double time, double h, Vertices& v) override;
  bool adjust(const Vertices& x, double time, double h, Vertices& v) override;
  void finish(Vertices& v) override;
  [[nodiscard]] bool done() const override { return converged_ && !beyond_ && !lost_; }

 private:
  /// A contact with its impulse in this step.
  struct Impulse {
    ContactConstraint contact;  ///< with force f [kg·m]
    double compliance;          ///< Σ weights²/m over free vertices [1/kg]
    Bounce bounce;
  };
  void find();
  /// Solves the known contacts and finds more until none is missed; sets v so that the vertices end there.
  void settle(Vertices& v);
  /// Returns the distance that a contact misses where its features are at `place`, negative if it misses none [m].
  [[nodiscard]] static double shortfall(const Impulse& impulse, const Eigen::Vector3d& place);
  /// Returns true if the target misses more than a tolerance of a contact [m], or opens a weld.
  [[nodiscard]] bool is_violated(const Impulse& impulse, double tolerance) const;
  /// Returns true if the target violates a contact.
  [[nodiscard]] bool any_violated() const;
  /// Returns true if the target violates a contact by so much that the step has not converged.
  [[nodiscard]] bool falls_short() const;
  /// Sets the target to the end of free flight, plus the effect of known forces.
  void apply_known();
  /// Repeats passes over all contacts until they no longer move. Returns false if the last pass still moved them.
  [[nodiscard]] bool solve();
  /// Returns the change of a contact's force, given its missing distance along the normal and its slip; of a weld,
  /// given its gap as the slip.
  [[nodiscard]] static Eigen::Vector3d change_of(const Impulse& impulse, double missing, const Eigen::Vector3d& slip);
  [[nodiscard]] bool any_collides() const;
  /// Returns true if the last solve moved vertices too little to cause other contacts.
  [[nodiscard]] bool stays_as_found() const;
  void hold();
  /// Moves the vertices of a contact with its obstacle, as pins. Returns true if any did not already.
  bool hold_with_obstacle(const ContactConstraint& contact, std::vector<double>& inverse_masses,
                          std::vector<Point>& velocities) const;

  std::vector<std::shared_ptr<ContactSource>> sources_;
  std::vector<double> inverse_masses_;  // 0 on pins [1/kg]
  std::vector<Impulse> impulses_, before_;
  std::vector<ContactConstraint> found_, held_;
  const Vertices* x_ = nullptr;
  FreeFlight flight_;
  Vertices target_, before_target_;
  bool converged_ = true;
  bool lost_ = false;    // true if pins make features of the cloth violate a contact
  bool beyond_ = false;  // true if the last solve ended at the limit of its passes and falls short
};

}  // namespace drape
