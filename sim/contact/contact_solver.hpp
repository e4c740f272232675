#pragma once

#include <memory>
#include <vector>

#include "sim/contact/contact.hpp"
#include "sim/contact/contact_preconditioner.hpp"
#include "sim/contact/contact_problem.hpp"
#include "sim/solvers/minimiser.hpp"

namespace drape {

/// Minimises g(x) under the contacts of a step: n·d(x) ≥ distance with Coulomb friction on the slip d(x) − d(start).
///
/// Method of multipliers (Hestenes 1969; Powell 1969) in the form for friction of Alart and Curnier 1991: with the
/// multiplier r of a contact and t = r − κ·(gap along n, slip across it), its force is
///   f = n·max(0, n·t) + P(t across n),   P the projection on the disc of radius µ·(n·f).
/// An iteration is a step of Newton's method on the augmented function, whose equations conjugate gradients solve, a
/// line search, and the new multipliers r = f. At the solution r = f: then contacts that bear a force are closed to
/// the tolerance, and those that stick have not slipped. Contacts are found anew after every iteration, with the
/// normals of where the cloth is then, so curved and moving obstacles need no case of their own.
class ContactSolver {
 public:
  explicit ContactSolver(const System& system);

  /// Begins a step from x, n×3 [m], between two times [s].
  void begin(const Vertices& x, double start, double end);

  /// Finds the contacts of a cloth that goes straight to `target`. Returns whether there are any.
  [[nodiscard]] bool touches(const Vertices& target);

  /// Moves the point, which has g's value and gradient, to the minimum under the contacts.
  /// @param tolerance of a vertex, and of gaps and slips of contacts that hold [m]
  StepReport solve(ContactProblem& problem, double tolerance, int most_iterations, Iterate& point);

  /// Work that obstacles have done on the cloth by moving, by the forces of the last solve [J].
  [[nodiscard]] double work_of_obstacles() const;

  /// Whether any of the obstacles moves that the cloth touches.
  [[nodiscard]] bool carried() const;

  /// Gives v, the velocities at the end of the step n×3 [m/s], the rebound of what arrived in it.
  /// @param before velocities at its start, n×3 [m/s]
  void rebound(const Vertices& before, double h, Vertices& v) const;

  [[nodiscard]] const std::vector<ContactConstraint>& contacts() const { return contacts_; }

 private:
  /// Force of a contact at x, with the radius of its disc of friction.
  struct Response {
    Eigen::Vector3d force;       // [N]
    Eigen::Matrix3d stiffness;   // of d [N/m]
    double energy = 0;           // of the augmented function [J]
    double residual = 0;         // |f − r|/κ [m]
    bool sticks = false;
  };
  [[nodiscard]] Response respond(const ContactConstraint& contact, const Vertices& x, double radius) const;
  void set_stiffness(const ContactProblem& problem);
  /// Finds the contacts of a cloth that goes straight to `target`.
  /// @param turn known ones to how their features touch now, too
  void find(const Vertices& target, bool turn);
  /// Adds the forces at x to a gradient; returns the contacts' part of the augmented function [J].
  double add_forces(const Vertices& x, Vertices& gradient);
  void find_radii(const Vertices& x, bool all);
  void find_direction(ContactProblem& problem, const Vertices& x, const Vertices& gradient, Vertices& direction);
  [[nodiscard]] double descend(ContactProblem& problem, Iterate& point, double value, double slope);
  /// Shortens the way to the point until nothing collides on it.
  void retreat(ContactProblem& problem, Iterate& point);

  const System& system_;
  ContactPreconditioner preconditioner_;
  std::vector<char> free_;
  int linear_iterations_ = 0;
  double damping_ = 0;                      // added to the Hessian, of its bound
  double concavity_ = 0;                    // share of the negative eigenvalues of the Hessian
  std::vector<ContactConstraint> contacts_, before_, held_;
  std::vector<Response> responses_;
  Vertices start_;                          // of the step
  Vertices gradient_, direction_, residual_, preconditioned_, search_, product_;
  Iterate trial_;
};

}  // namespace drape
